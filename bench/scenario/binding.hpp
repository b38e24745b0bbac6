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
#include <utility>
#include <vector>

#include "dbc/wire/message_info.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {
struct Database;
}

namespace canhil::estimators {
struct Estimator;
}

namespace canhil::protection {
class Protection;
}

namespace canhil::sensors {
struct Kind;
}

namespace canhil::world {
class FlightRecord;
}

namespace canhil::scenario {

class NodeSettings;
struct NodeTable;
struct Scenario;

struct Binding {
  struct Files {
    std::string mapping, dbc;
  };

  /// What events of a scenario may send.
  struct Channel {
    std::string name;
    bool answers = false;        ///< the target may answer
    std::size_t most_bytes = 8;  ///< of a request
  };

  /// A quantity that the targets report.
  struct Reported {
    std::string name, si;  ///< SI unit; empty: a plain number
  };

  /// The parts of a sensor's samples that the bench sends. A fault of another part changes nothing on the
  /// bus.
  struct Carried {
    bool samples = true;  ///< at all
    bool times = true, intervals = true;
    std::uint64_t values = ~std::uint64_t{0};  ///< bit i: value i
    std::uint32_t flags = ~std::uint32_t{0};   ///< validity
  };

  Binding() = default;
  Binding(const Binding&) = delete;
  Binding& operator=(const Binding&) = delete;
  virtual ~Binding() = default;

  // A binding of which nothing is known says what each function has as its default.
  /// The counter and checksum of one of `messages`; null: it has none.
  [[nodiscard]] virtual std::shared_ptr<const protection::Protection> protection_of(
      const MessageInfo& /*message*/) const {
    return nullptr;
  }
  /// The message that closes the sample group of a node; null: the messages are not those of single nodes.
  [[nodiscard]] virtual const MessageInfo* closing_of(const NodeTable& /*node*/) const { return nullptr; }
  /// Whether the bench sends a message with the samples of these nodes.
  [[nodiscard]] virtual bool is_played(const MessageInfo& /*message*/,
                                       std::span<const NodeSettings> /*nodes*/) const {
    return false;
  }
  [[nodiscard]] virtual Carried carried(const sensors::Kind& /*sensor*/) const { return {}; }
  /// The bytes of the message of one of `channels`, from values of its signals in their units; the others are
  /// 0. Error: one phrase.
  [[nodiscard]] virtual Result<std::vector<std::uint8_t>> encoded(
      std::size_t /*channel*/, std::span<const std::pair<std::string, double>> /*values*/) const {
    return failure("belong to no channel");
  }
  /// Whether a message belongs to events of a scenario alone: a request or its answer.
  [[nodiscard]] virtual bool is_of_events(const MessageInfo& /*message*/) const { return false; }
  /// The one of `senders` that sends a message of the bench; empty: the bench itself.
  [[nodiscard]] virtual std::string_view sender_of(const MessageInfo& /*message*/) const { return ""; }
  /// The DBCs of the bus, with all signals. They live as long as the binding.
  [[nodiscard]] virtual std::vector<const dbc::Database*> databases() const { return {}; }
  /// The only estimator whose targets send a message; empty: every target sends it, or none does.
  [[nodiscard]] virtual std::string_view estimator_of(const MessageInfo& /*message*/) const { return ""; }
  /// Error, one line: the scenario has no sensor for a message, or its messages cannot carry the values of
  /// the flight.
  [[nodiscard]] virtual Result<void> fits(const Scenario& /*scenario*/,
                                          const world::FlightRecord& /*flight*/) const {
    return {};
  }

  /// The messages of bench and target; is_targets() tells them apart.
  std::span<const MessageInfo> messages{};
  /// The estimators that a target may run. Each mapped target is presented as one.
  std::span<const estimators::Estimator* const> estimators{};
  std::vector<const sensors::Kind*> sensors{};  ///< those with names of their own that it declares
  std::vector<std::string> senders{};           ///< the nodes of the DBC that may have a bus of their own
  std::vector<Channel> channels{};
  std::vector<std::string> flags{};  ///< of the targets
  std::vector<Reported> reported{};  ///< quantities whose values may be commands of a plant
  /// The files of which it is made, as named by the user: one for each target. None: built into the program.
  std::vector<Files> files{};
  std::uint64_t hash = 0;      ///< hash of the files; 0: built in
  std::uint64_t dbc_hash = 0;  ///< hash of the DBC, or of the DBCs
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

/// The mappings, separated by commas.
std::string to_text(const std::vector<Binding::Files>& files);

}  // namespace canhil::scenario
