// A mapping connects a DBC of another project to the bench: a TOML file beside the DBC assigns its signals to
// the bench's quantities (docs/mapping.md).
//
// A play is a group of messages that the bench sends; a hear is a message of a target. Both are independent
// of any scenario. Several targets of a run, each with its mapping, share the plays that are equal.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/estimator.hpp"
#include "bench/mapping/reference_quantities.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/sensors/measurands.hpp"
#include "dbc/parser/database.hpp"
#include "dbc/parser/plan.hpp"
#include "dbc/protection/protection.hpp"
#include "dbc/transport/fast_packet.hpp"
#include "dbc/transport/iso_tp.hpp"
#include "dbc/transport/j1939.hpp"
#include "dbc/wire/j1939.hpp"
#include "dbc/wire/message_places.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::mapping {

/// A message of the DBC and its index in Binding::messages.
struct Mapped {
  explicit Mapped(const dbc::Message& of) : message(&of), plan(of) {}

  const dbc::Message* message;
  dbc::MessagePlan plan;
  std::size_t index = 0;
  std::optional<protection::Protection> protection{};

  /// The number of frames of the message.
  [[nodiscard]] std::size_t frames() const {
    if (message->j1939_transport()) return 1 + transport::j1939_packets(message->size);
    return message->fast_packet ? transport::fast_packet_frames(message->size) : 1;
  }
  /// The number of bytes of each frame.
  [[nodiscard]] unsigned frame_size() const { return has_several_frames() ? 8 : message->size; }
  /// Whether a transport protocol carries the message.
  [[nodiscard]] bool has_several_frames() const { return message->fast_packet || message->j1939_transport(); }
  /// A frame of the message.
  [[nodiscard]] Frame frame(std::span<const std::uint8_t> bytes) const;
  /// The index of one of the message's signals.
  [[nodiscard]] std::size_t number(const dbc::Signal& signal) const {
    return static_cast<std::size_t>(&signal - message->signals.data());
  }
};

/// The source of a signal that the bench sends.
struct Source {
  const dbc::Signal* signal = nullptr;
  const sensors::Measurand* measurand = nullptr;  ///< null: a constant, or the time
  bool time = false;                              ///< the time of validity, from the start of the run
  double value = 0;                               ///< a constant, in the signal's unit
  double factor = 1;                              ///< from SI to the signal's unit
  std::optional<std::uint64_t> invalid{};         ///< raw value to send when the sensor's value is invalid
};

struct PlayedMessage {
  Mapped of;
  std::vector<Source> sources;
};

/// A group of messages that the bench sends together.
struct Play {
  std::string name;  ///< name of the play's last message
  std::vector<PlayedMessage> messages;
  const sensors::Kind* sensor = nullptr;  ///< its samples trigger the play; null: sent at its own times
  std::int64_t period_us = 0;             ///< a multiple of the sensor's period, if there is a sensor
  std::int64_t latency_us = 0;            ///< added to the sensor's latency
};

/// A signal that carries a quantity of the target, its sigma, or the correlation of its error with another.
struct ReportedSignal {
  enum class What : std::uint8_t { value, sigma, correlation };
  const dbc::Signal* signal = nullptr;
  const ReferenceQuantity* quantity = nullptr;
  What what = What::value;
  const ReferenceQuantity* other = nullptr;  ///< of a correlation
  bool in_metres = false;                    ///< the sigma of a latitude or longitude is in metres
  double factor = 1;                         ///< from the signal's unit to SI
  std::optional<std::uint64_t> invalid{};    ///< raw value that means "invalid"
  /// An angle that is computed from the quaternion of the message; null: the signal carries the value itself.
  double world::Euler::*angle = nullptr;
};

/// The attitude as a quaternion w, x, y, z, which rotates from body axes to north, east, down (C_bn).
struct ReportedQuaternion {
  std::array<const dbc::Signal*, 4> parts{};
  std::array<double, 4> factors{};
  std::array<std::optional<std::uint64_t>, 4> invalid{};  ///< raw values that mean "invalid"
};

/// A named state of a target: raw values of a signal, or of some of its bits.
struct ReportedFlag {
  std::string name;
  const dbc::Signal* signal = nullptr;
  std::uint64_t mask = 0;                ///< of the bits of the raw value that are considered
  std::optional<std::uint64_t> value{};  ///< the bits that set the flag; none: any but 0
  bool is_sign = false;                  ///< the flag is a sign of trouble

  [[nodiscard]] bool is_set(std::uint64_t raw) const {
    return value ? (raw & mask) == *value : (raw & mask) != 0;
  }
};

/// An echo: the target copies the value of a signal of its cause (`original`) into a signal of its answer
/// (`repeated`).
struct Echo {
  const dbc::Signal* repeated = nullptr;
  std::size_t message = 0;  ///< index in the play
  const dbc::Signal* original = nullptr;
};

struct Hear {
  Mapped of;
  std::size_t target = 0;  ///< index of its sender in Mapping::targets
  std::vector<ReportedSignal> reported_signals;
  std::optional<ReportedQuaternion> quaternion{};
  std::vector<ReportedFlag> flags{};
  std::optional<std::size_t> answers{};  ///< index of the answered play; none: sent independently of plays
  std::optional<Echo> echo{};            ///< none: the cause is the latest stimulus before the message
  /// The period of the target's own task that sends the message: it answers the latest stimulus, not each. 0:
  /// the target must answer each stimulus.
  std::int64_t task_us = 0;

  /// Whether each stimulus of the play `answers` must have an answer.
  [[nodiscard]] bool is_owed() const { return answers && task_us == 0; }
};

/// What events of a scenario send to a target, and what the target answers.
struct EventChannel {
  enum class Transport : std::uint8_t { frame, iso_tp };
  std::string name;
  Mapped request;
  std::optional<Mapped> response{};
  Transport transport = Transport::frame;
  transport::IsoTpSettings settings{};
};

/// One target: what it sends and how it is presented as an estimator of the bench.
struct MappedTarget {
  std::string name;  ///< name of its estimator
  std::string file;  ///< its mapping
  dbc::Database database;
  std::span<const Hear> hears{};
  std::deque<ReferenceQuantity> own{};                    ///< quantities that its mapping defines
  std::vector<const quantities::Quantity*> quantities{};  ///< each once
  std::vector<const quantities::Quantity*> of_runs{};  ///< these, and those of which they are the components
  const quantities::Layout* layout = nullptr;
  std::vector<std::string_view> closing{};
  std::vector<std::string_view> plain_marks{};  ///< its messages, and flags that are no signs of trouble
  std::optional<estimators::Estimator> estimator{};
};

/// The mappings of all targets of a run.
struct Mapping final : scenario::Binding {
  Mapping() { any_sensor = true; }
  [[nodiscard]] std::shared_ptr<const protection::Protection> protection_of(
      const MessageInfo& message) const override;
  [[nodiscard]] bool is_played(const MessageInfo& message,
                               std::span<const scenario::NodeSettings> nodes) const override;
  [[nodiscard]] Carried carried(const sensors::Kind& sensor) const override;
  [[nodiscard]] std::vector<const dbc::Database*> databases() const override;
  [[nodiscard]] std::string_view sender_of(const MessageInfo& message) const override;
  [[nodiscard]] std::string_view estimator_of(const MessageInfo& message) const override;
  [[nodiscard]] Result<std::vector<std::uint8_t>> encoded(
      std::size_t channel, std::span<const std::pair<std::string, double>> values) const override;
  [[nodiscard]] bool is_of_events(const MessageInfo& message) const override;
  [[nodiscard]] Result<void> fits(const scenario::Scenario& scenario,
                                  const world::FlightRecord& flight) const override;

  std::deque<MappedTarget> targets;  ///< at least one
  std::vector<Play> plays;
  std::vector<Hear> hears;                   ///< of all targets, in their order
  std::vector<EventChannel> event_channels;  ///< in the order of Binding::channels
  const MappedTarget* guide = nullptr;       ///< its answers guide the missile; null: none does
  /// For J1939: the index of each message by its parameter group, because any source address and any priority
  /// is accepted.
  std::map<std::uint32_t, std::size_t> by_group;

  // Storage for Binding::messages and Binding::estimators.
  std::vector<MessageInfo> infos;
  std::vector<std::string> sent_by;  ///< for each message of the bench: the node that sends it
  std::deque<std::string_view> groups;
  std::vector<const estimators::Estimator*> presented;
};

/// Reads a named file. Error: one line.
using ReadText = std::function<Result<std::string>(const std::string& file)>;
/// Reads a file from the disk.
Result<std::string> read_from_disk(const std::string& file);

/// Finds the messages that a frame is.
class Places {
 public:
  explicit Places(const Mapping& mapping);
  /// The index in Binding::messages; MessagePlaces::nowhere if the frame is not a message of the mapping. If
  /// several targets send messages of this id, the index of one of them.
  [[nodiscard]] std::size_t operator()(const Frame& frame) const {
    const std::size_t index = by_id_(frame);
    if (index != MessagePlaces::nowhere || !frame.extended || frame.error) return index;
    const auto found = by_group_.find(wire::j1939_group(frame.id));
    if (found != by_group_.end()) return found->second;
    const auto parts = in_parts(frame);
    return parts.empty() ? MessagePlaces::nowhere : index_of_[parts.front()];
  }
  /// The messages of targets that a frame is, as indices of Mapping::hears. A frame of the transport protocol
  /// of J1939 may be a part of several messages.
  [[nodiscard]] std::span<const std::size_t> hears(const Frame& frame) const {
    const std::size_t index = (*this)(frame);
    if (index == MessagePlaces::nowhere) return {};
    const auto parts = in_parts(frame);
    return parts.empty() ? std::span<const std::size_t>(hears_[index]) : parts;
  }

 private:
  MessagePlaces by_id_;
  const std::map<std::uint32_t, std::size_t>& by_group_;
  std::vector<std::vector<std::size_t>> hears_;  // for each message
  // The messages, as indices of Mapping::hears, that J1939-21 sends in several frames: from any source, and,
  // if some are heard from one source only, all that this source may send.
  std::vector<std::size_t> from_any_;
  std::map<std::uint8_t, std::vector<std::size_t>> from_;
  std::vector<std::size_t> index_of_;  // in Binding::messages, for each of Mapping::hears

  [[nodiscard]] std::span<const std::size_t> in_parts(const Frame& frame) const {
    if (from_any_.empty() && from_.empty()) return {};
    if (!transport::J1939Receiver::carries(frame)) return {};
    const auto own = from_.find(wire::j1939_source(frame.id));
    return own == from_.end() ? from_any_ : own->second;
  }
};

/// Reads the mappings of the targets of a run, and their DBCs. A mapping gives the path of its DBC relative
/// to the folder of the mapping. An error is one line of text.
Result<std::shared_ptr<const Mapping>> read_mappings(std::span<const std::string> files,
                                                     const ReadText& read = read_from_disk);
/// Reads the mapping of one target.
Result<std::shared_ptr<const Mapping>> read_mapping(const std::string& file,
                                                    const ReadText& read = read_from_disk);

/// The layout of samples with the quantities that `columns` names, in the order of these names. Repeated
/// calls return the same object, so the samples of a run and stored samples have one common layout. Null: for
/// one of the quantities, the bench has no truth.
const quantities::Layout* find_layout(std::string_view columns);

/// Presents a mapped target as an estimator. The result refers to the target, which must not move.
estimators::Estimator estimator_of(const MappedTarget& target);

/// The vocabulary for reading a scenario. If the targets of the scenario name mappings (by paths relative
/// to the scenario's file), the vocabulary comes from these; otherwise it comes from canhil's own DBC. An
/// error is one line of text. `settings`: see scenario::parse(). This function does not report syntax errors
/// of TOML; the reader of the scenario reports them.
Result<scenario::DbcVocabulary> contract_of(std::string_view text, const std::string& file,
                                            const scenario::DbcVocabulary& own,
                                            const ReadText& read = read_from_disk,
                                            std::span<const scenario::Setting> settings = {});

}  // namespace canhil::mapping
