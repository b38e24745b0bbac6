// A target with a DBC of its own, as far as a scenario knows it. The reader of its DBC and mapping
// (bench/mapping) fills this in.
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

  /// The messages of bench and target; those of the target have the same sender as TargetHeartbeat.
  std::vector<MessageInfo> messages;
  std::string file;            ///< the mapping file, as named by the user
  std::uint64_t hash = 0;      ///< of all texts that it was read from
  std::string dbc_file;        ///< its DBC
  std::uint64_t dbc_hash = 0;  ///< of its DBC
  /// Its answers name their causes, so virtual time can wait for them.
  bool answers_by_name = false;
  /// Its quantities, presented as an estimator.
  const estimators::Estimator* estimator = nullptr;
};

}  // namespace canhil::scenario
