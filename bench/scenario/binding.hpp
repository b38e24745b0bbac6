// How a DBC is bound to the bench: its messages, who sends them, and what bench and target say to each other
// beside samples and answers. canhil.dbc has a binding (bench/bindings/canhil); a mapping is the binding of
// another DBC (bench/mapping). The rest of the bench asks the properties of a binding, and not whose DBC it
// is.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "dbc/wire/message_info.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::estimators {
struct Estimator;
}

namespace canhil::protection {
class Protection;
}

namespace canhil::world {
class FlightRecord;
}

namespace canhil::scenario {

class NodeSettings;
struct NodeTable;
struct Scenario;

struct Binding {
  Binding() = default;
  Binding(const Binding&) = delete;
  Binding& operator=(const Binding&) = delete;
  virtual ~Binding() = default;

  /// The counter and checksum of one of `messages`; null: it has none.
  [[nodiscard]] virtual std::shared_ptr<const protection::Protection> protection_of(
      const MessageInfo& message) const = 0;
  /// The message that closes the sample group of a node; null: the messages are not those of single nodes.
  [[nodiscard]] virtual const MessageInfo* closing_of(const NodeTable& node) const = 0;
  /// Whether the bench sends a message with the samples of these nodes.
  [[nodiscard]] virtual bool is_played(const MessageInfo& message,
                                       std::span<const NodeSettings> nodes) const = 0;
  /// The only estimator whose targets send a message; empty: every target sends it, or none does.
  [[nodiscard]] virtual std::string_view estimator_of(const MessageInfo& message) const = 0;
  /// Error, one line: the scenario has no sensor for a message, or its messages cannot carry the values of
  /// the flight.
  [[nodiscard]] virtual Result<void> fits(const Scenario& scenario,
                                          const world::FlightRecord& flight) const = 0;

  /// The messages of bench and target; is_targets() tells them apart.
  std::span<const MessageInfo> messages{};
  /// The estimators that a target may run. The quantities that a mapped target reports are presented as one.
  std::span<const estimators::Estimator* const> estimators{};
  std::string file{};          ///< its file, as named by the user; empty: built into the program
  std::uint64_t hash = 0;      ///< hash of the file and its DBC; 0: built in
  std::string dbc_file{};      ///< the file of the DBC; empty: built in
  std::uint64_t dbc_hash = 0;  ///< hash of the DBC
  /// The protocol `canhil`: commands configure, start and stop the target, and it says what it does
  /// (TargetHeartbeat). Without it, the target runs independently of the bench.
  bool handshake = false;
  bool time_base = false;    ///< the bench sends its time; in lockstep the target acknowledges each step
  bool containers = false;   ///< a second DBC packs the messages in containers of CAN FD
  bool any_sensor = false;   ///< it can carry any sensor, also those with names of their own
  bool closes_loop = false;  ///< answers guide the missile
  /// A sample has an answer that names it, so virtual time can wait for that answer.
  bool answers_by_name = false;
};

}  // namespace canhil::scenario
