// The facts that a scenario needs about a target with its own DBC. The reader of this DBC and of the mapping
// (bench/mapping) provides these facts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dbc/wire/message_info.hpp"

namespace canhil::estimators {
struct Estimator;
}

namespace canhil::protection {
class Protection;
}

namespace canhil::scenario {

struct Foreign {
  Foreign() = default;
  Foreign(const Foreign&) = delete;
  Foreign& operator=(const Foreign&) = delete;
  virtual ~Foreign() = default;

  /// The protection of a message that the bench sends; null: it has none. `message`: index in `messages`.
  [[nodiscard]] virtual const protection::Protection* protection_of(std::size_t message) const = 0;

  /// The messages of bench and target; the target's messages have the same sender as TargetHeartbeat.
  std::vector<MessageInfo> messages;
  std::string file;            ///< the mapping file, as named by the user
  std::uint64_t hash = 0;      ///< hash of the mapping file and its DBC
  std::string dbc_file;        ///< the DBC that the mapping names
  std::uint64_t dbc_hash = 0;  ///< hash of that DBC
  /// At least one message of the target names its cause, so virtual time can wait for this message.
  bool answers_by_name = false;
  /// The quantities that the target reports, presented as an estimator.
  const estimators::Estimator* estimator = nullptr;
};

}  // namespace canhil::scenario
