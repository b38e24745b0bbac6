// A target that does not speak the project's contract, as a scenario knows it. Who reads its DBC and its
// mapping fills it in (bench/mapping).
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

  /// What bench and target send; the target's have the sender of the contract's TargetHeartbeat.
  std::vector<MessageInfo> messages;
  std::string file;            ///< that describes it, as it was named
  std::uint64_t hash = 0;      ///< of the texts that it was read from
  std::string dbc_file;        ///< its DBC
  std::uint64_t dbc_hash = 0;  ///< of that
  /// Its answers say what they answer, so that virtual time can wait for them.
  bool answers_by_name = false;
  /// What it tells, as that of an estimator.
  const estimators::Estimator* estimator = nullptr;
};

}  // namespace canhil::scenario
