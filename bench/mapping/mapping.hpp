// Somebody else's contract: a DBC, and a TOML file beside it that says which of its signals are which of the
// bench's quantities. docs/mapping.md.
//
// A play is a group of messages that the bench sends; a hear a message of the target. Neither knows a
// scenario.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/estimator.hpp"
#include "bench/mapping/reference_quantities.hpp"
#include "bench/mapping/stimuli.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/foreign.hpp"
#include "dbc/parser/database.hpp"
#include "dbc/parser/plan.hpp"
#include "dbc/protection/protection.hpp"
#include "dbc/wire/message_places.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::mapping {

/// A message of the DBC, and its place in Mapping::messages.
struct Mapped {
  explicit Mapped(const dbc::Message& of) : message(&of), plan(of) {}

  const dbc::Message* message;
  dbc::MessagePlan plan;
  std::size_t index = 0;
  std::optional<protection::Protection> protection{};

  /// The number of one of the message's signals.
  [[nodiscard]] std::size_t number(const dbc::Signal& signal) const {
    return static_cast<std::size_t>(&signal - message->signals.data());
  }
};

/// What a signal of the bench carries.
struct Source {
  const dbc::Signal* signal = nullptr;
  const Stimulus* stimulus = nullptr;      ///< null: a constant, or the time
  bool time = false;                       ///< of validity, from the start of the run
  double value = 0;                        ///< a constant, in the signal's unit
  double factor = 1;                       ///< from SI to the signal's unit
  std::optional<std::uint64_t> invalid{};  ///< raw value in place of what the node calls invalid
};

struct PlayedMessage {
  Mapped of;
  std::vector<Source> sources;
};

/// A group of messages that the bench sends one after the other.
struct Play {
  std::string name;  ///< of its last message
  std::vector<PlayedMessage> messages;
  std::string_view node;        ///< whose samples it follows
  std::int64_t period_us = 0;   ///< a multiple of the node's
  std::int64_t latency_us = 0;  ///< beside the node's
};

/// What a signal of the target tells.
struct ReportedSignal {
  const dbc::Signal* signal = nullptr;
  const ReferenceQuantity* quantity = nullptr;
  bool sigma = false;                      ///< of the quantity, in place of its value
  double factor = 1;                       ///< from the signal's unit to SI
  std::optional<std::uint64_t> invalid{};  ///< raw value that tells nothing
};

/// A signal of the target that repeats one of what it answers.
struct Echo {
  const dbc::Signal* repeated = nullptr;
  std::size_t message = 0;  ///< of the play
  const dbc::Signal* original = nullptr;
};

struct Hear {
  Mapped of;
  std::vector<ReportedSignal> reported_signals;
  std::optional<std::size_t> answers{};  ///< a play; none: it comes by itself
  std::optional<Echo> echo{};            ///< none: it answers the latest before it
};

struct Mapping final : scenario::Foreign {
  dbc::Database database;
  std::vector<Play> plays;
  std::vector<Hear> hears;
  std::string name;  ///< of the target, in place of an estimator's
  /// By J1939 parameter group: places of messages that are heard from any source, at any priority.
  std::map<std::uint32_t, std::size_t> by_group;

  // What Foreign::messages and Foreign::estimator are made of.
  std::deque<std::string_view> groups;
  std::vector<const quantities::Quantity*> quantities;  ///< each once
  const quantities::Layout* layout = nullptr;
  std::vector<std::string_view> closing;
  std::optional<estimators::Estimator> own;
};

/// Gives the text of a file that is named. Error: one line.
using ReadText = std::function<Result<std::string>(const std::string& file)>;
/// From the disk.
Result<std::string> read_from_disk(const std::string& file);

/// The parameter group of a J1939 id (SAE J1939-21, 5.2): without priority and source, and of a message to
/// one destination (PDU format below 240) without that.
constexpr std::uint32_t j1939_group(std::uint32_t id) {
  constexpr std::uint32_t first_broadcast = 240;
  const std::uint32_t group = (id >> 8U) & 0x3FFFFU;
  return ((group >> 8U) & 0xFFU) < first_broadcast ? group & 0x3FF00U : group;
}

/// From a frame to the place of its message in Mapping::messages.
class Places {
 public:
  explicit Places(const Mapping& mapping) : by_id_(mapping.messages), by_group_(mapping.by_group) {}
  /// MessagePlaces::nowhere: none of the mapping.
  [[nodiscard]] std::size_t operator()(const Frame& frame) const {
    const std::size_t index = by_id_(frame);
    if (index != MessagePlaces::nowhere || !frame.extended || frame.error) return index;
    const auto found = by_group_.find(j1939_group(frame.id));
    return found == by_group_.end() ? MessagePlaces::nowhere : found->second;
  }

 private:
  MessagePlaces by_id_;
  const std::map<std::uint32_t, std::size_t>& by_group_;
};

/// Reads a mapping and the DBC that it names, relative to itself. Error: one line.
Result<std::shared_ptr<const Mapping>> read_mapping(const std::string& file,
                                                    const ReadText& text = read_from_disk);

/// Of samples that tell these quantities, in their order, each of which has a truth here: the same object
/// each time, so that stored samples and those of a run have the same. None: null.
const quantities::Layout* find_layout(std::string_view columns);

/// What the bench knows of a target that a mapping describes, as of an estimator. The mapping must stay where
/// it is.
estimators::Estimator estimator_of(const Mapping& mapping);

/// The contract by which a scenario is read: the project's, or that of the mapping that its [target] names,
/// relative to the scenario's file. Error: one line; a text that is no TOML is left to who reads it.
Result<scenario::DbcVocabulary> contract_of(std::string_view text, const std::string& file,
                                            const scenario::DbcVocabulary& own,
                                            const ReadText& read = read_from_disk);

}  // namespace canhil::mapping
