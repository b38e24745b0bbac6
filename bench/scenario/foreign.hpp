// The facts about a target with its own DBC that a scenario needs. The reader of its DBC and mapping
// (bench/mapping) provides them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dbc/wire/message_info.hpp"

namespace canhil::estimators {
struct Estimator;
}

namespace canhil::scenario {

struct Foreign {
  Foreign() = default;
  Foreign(const Foreign&) = delete;
  Foreign& operator=(const Foreign&) = delete;
  virtual ~Foreign() = default;

  /// The messages of bench and target; the target's messages have the same sender as TargetHeartbeat.
  std::vector<MessageInfo> messages;
  std::string file;            ///< the mapping file, as named by the user
  std::uint64_t hash = 0;      ///< hash of all texts that it was read from
  std::string dbc_file;        ///< its DBC
  std::uint64_t dbc_hash = 0;  ///< hash of that DBC
  /// Its answers name their causes, so virtual time can wait for them.
  bool answers_by_name = false;
  /// Its quantities, presented as an estimator.
  const estimators::Estimator* estimator = nullptr;
};

}  // namespace canhil::scenario
