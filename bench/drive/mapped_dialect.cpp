// A mapped target has no handshake and runs independently of the bench. Before the run, the bench waits until
// the settling time of the target is over and until a message of the target shows that the target is present.
// A target that sends only answers is silent before the run; for such a target, the bench waits only for the
// settling time, and until the process that it started has joined the bus. A process that has joined and is
// silent nevertheless may wait for its first sample: the run then begins. On a CAN interface, a target may be
// on another machine, where nobody sees it join.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "bench/checks/judge.hpp"
#include "bench/drive/dialect.hpp"
#include "bench/mapping/command_receiver.hpp"
#include "bench/mapping/event_sender.hpp"
#include "bench/mapping/listener.hpp"
#include "bench/mapping/player.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::drive {
namespace {

constexpr std::int64_t poll_ns = 20'000'000;

// Sends nothing, because the bench sends no time base on this bus. This node only makes the schedule last
// until the end of the run.
class EndOfRun final : public nodes::Node {
 public:
  explicit EndOfRun(std::int64_t end_us) : end_us_(end_us) {}
  [[nodiscard]] std::int64_t due_us() const override { return over_ ? nodes::never_us : end_us_; }
  void transmit(nodes::Transmission& /*out*/) override { over_ = true; }

 private:
  std::int64_t end_us_;
  bool over_ = false;
};

// Any message of the target shows that the target is present. In virtual time, the echo of a played message
// shows that the target has processed that message.
class MappedWatch final : public observe::TargetWatch {
 public:
  explicit MappedWatch(const mapping::Conversation& conversation)
      : conversation_(conversation), places_(conversation.mapping), passing_(conversation) {}

  void received(const Received& received) override {
    if (received.own) return;
    for (const std::size_t index : places_.hears(received.frame)) {
      const mapping::Hear& hear = conversation_.mapping.hears[index];
      // A frame of the transport protocol of J1939 may be a part of another message.
      const bool is_part = hear.of.message->j1939_transport();
      const bool is_awaited = hear.is_owed() && hear.echo;
      if (!is_part) note(hear);
      if (!is_part && !is_awaited) continue;
      // An answer with a wrong checksum is an answer too: the target has processed the sample.
      const mapping::Receiver::Taken taken = receivers_[index].take(hear.of, received.frame);
      if (is_part && !taken.bytes.empty()) note(hear);
      if (!is_awaited) continue;
      if (taken.bytes.size() != hear.of.message->size || *hear.answers != awaited_play_) continue;
      const mapping::Sent* cause = mapping::cause_of(conversation_, hear, taken.bytes);
      if (cause != nullptr && cause->valid_us == awaited_us_) waits_for_.erase(hear.of.index);
    }
  }
  bool heard() override { return std::exchange(heard_, false); }
  /// The targets of which a message came, as indices of Mapping::targets.
  [[nodiscard]] const std::set<std::size_t>& heard_from() const { return heard_from_; }
  [[nodiscard]] std::optional<std::string> fault() const override { return std::nullopt; }

  bool closes_step(const Frame& frame) override {
    const auto whole = passing_.take(frame);
    if (!whole) return false;
    waits_for_.clear();
    for (const mapping::Hear& hear : conversation_.mapping.hears) {
      if (hear.is_owed() && hear.echo && *hear.answers == whole->play) waits_for_.insert(hear.of.index);
    }
    awaited_play_ = whole->play;
    awaited_us_ = whole->sent->valid_us;
    return !waits_for_.empty();
  }
  [[nodiscard]] bool step_done() const override { return waits_for_.empty(); }
  [[nodiscard]] std::string step() const override {
    const auto& mapping = conversation_.mapping;
    return fmt::format("{} by {} (in virtual time each sample needs an answer with its echo)",
                       mapping.plays[awaited_play_].name,
                       waits_for_.empty() ? "" : mapping.messages[*waits_for_.begin()].name);
  }

 private:
  void note(const mapping::Hear& hear) {
    heard_ = true;
    heard_from_.insert(hear.target);
  }

  const mapping::Conversation& conversation_;
  mapping::Places places_;
  mapping::Passing passing_;
  std::map<std::size_t, mapping::Receiver> receivers_;  // by index of Mapping::hears
  bool heard_ = false;
  std::set<std::size_t> heard_from_;
  std::size_t awaited_play_ = 0;
  std::int64_t awaited_us_ = 0;
  std::set<std::size_t> waits_for_;  // indices of the messages that must still answer the played sample
};

// Collects the ids of frames that are not in the mapping. The error message that reports a missing target
// lists these ids.
class Strangers final : public observe::Observer {
 public:
  explicit Strangers(const mapping::Places& places) : places_(places) {}
  void received(const Received& received) override {
    if (!received.own && !received.frame.error && places_(received.frame) == MessagePlaces::nowhere)
      ids_.insert(received.frame.id);
  }
  [[nodiscard]] std::string to_text() const {
    if (ids_.empty()) return "nothing was received";
    constexpr std::size_t most = 8;
    std::vector<std::string> some;
    for (const std::uint32_t id : ids_) {
      if (some.size() < most) some.push_back(fmt::format("{:X}", id));
    }
    return fmt::format("only frames of other ids were received: {}{}", fmt::join(some, ", "),
                       ids_.size() > most ? ", ..." : "");
  }

 private:
  const mapping::Places& places_;
  std::set<std::uint32_t> ids_;
};

// The longest times of all targets, as they are on one bus.
scenario::OwnStart longest_of(const std::vector<scenario::TargetSetup>& targets) {
  scenario::OwnStart longest;
  for (const scenario::TargetSetup& target : targets) {
    longest.settle_us = std::max(longest.settle_us, target.own_start->settle_us);
    longest.silence_us = std::max(longest.silence_us, target.own_start->silence_us);
  }
  return longest;
}

class MappedDialect final : public Dialect {
 public:
  MappedDialect(const Setting& setting, const mapping::Mapping& mapping)
      : of_(setting),
        start_(longest_of(setting.scenario.targets)),
        conversation_(mapping),
        places_(mapping),
        dialogue_(mapping, setting.scenario.events) {}

  std::unique_ptr<Schedule> schedule(std::unique_ptr<faults::Faults> faults) override {
    std::vector<std::unique_ptr<nodes::Node>> players;
    players.push_back(std::make_unique<mapping::Player>(
        conversation_,
        run_of(of_.scenario, of_.truth, of_.flight.per_run_truth, of_.run_index, faults.get())));
    if (!of_.of_log && !of_.scenario.events.empty()) players.push_back(talker(scenario::Phase::during));
    if (!of_.scenario.plant.steered.empty())
      players.push_back(std::make_unique<mapping::CommandReceiver>(conversation_, *of_.scenario.plant.setup,
                                                                   *of_.flight.per_run_truth.plant));
    return std::make_unique<Schedule>(std::move(players), std::make_unique<EndOfRun>(of_.truth.end_us()),
                                      Rounding::as_on_the_bus, std::move(faults),
                                      of_.flight.per_run_truth.plants());
  }
  // Watchers look up played messages in the conversation, and the player changes the conversation.
  [[nodiscard]] bool watches_frames_alone() const override { return false; }
  std::unique_ptr<observe::Watcher> watcher(bool /*with_times*/) override {
    WireFacts wire = of_.wire;
    const auto messages = conversation_.mapping.messages;
    wire.fd = messages.front().fd;
    return std::make_unique<mapping::Listener>(
        conversation_, checks::timed_windows(of_.scenario.checks, messages), wire, of_.virtual_time);
  }
  std::unique_ptr<observe::TargetWatch> target_watch(bool /*alone*/) override {
    return std::make_unique<MappedWatch>(conversation_);
  }

  Result<void> configure(Link& link, nodes::Transmission& /*out*/,
                         const std::function<std::optional<std::string>()>& gone) override {
    MappedWatch watch(conversation_);
    Strangers strangers(places_);
    const Attached watched(link, watch), others(link, strangers);
    std::set<std::size_t> speakers;  // a target that only answers is silent before the run
    for (const mapping::Hear& hear : conversation_.mapping.hears) {
      if (!hear.answers) speakers.insert(hear.target);
    }
    const auto is_there = [&] { return std::ranges::includes(watch.heard_from(), speakers); };
    if (!following_) following_.emplace(link, dialogue_);
    const std::int64_t settled_ns = link.now_ns() + start_.settle_us * 1000;
    if (auto talked = talk_before(link, settled_ns, gone); !talked) return talked;
    const std::int64_t limit_ns = std::max(settled_ns, link.now_ns() + find_limit_ns);
    // Where not every node is counted, a target that was heard is there, whether it is counted or not.
    const bool must_join = of_.others.complete || speakers.empty();
    while (link.now_ns() < settled_ns || !is_there() || (must_join && absent())) {
      if (link.drain() == LinkState::down)
        return failure(fmt::format("bus '{}': gone before the run", link.port().name()));
      if (const auto why = gone()) return failure(fmt::format("{} before the run", *why));
      const std::int64_t now_ns = link.now_ns();
      if (now_ns >= limit_ns && (joined() || (is_there() && !of_.others.complete))) break;
      if (now_ns >= limit_ns) return failure(complaint(link, watch, strangers));
      link.wait_until(std::min(now_ns + poll_ns, limit_ns));
    }
    return {};
  }
  void stop(Link& link, nodes::Transmission& /*out*/) override {
    static_cast<void>(talk(link, scenario::Phase::after, [] { return std::nullopt; }));
  }
  observe::Observer* dialogue() override { return of_.scenario.events.empty() ? nullptr : &dialogue_; }
  [[nodiscard]] std::vector<checks::Exchange> exchanges() const override { return dialogue_.exchanges(); }
  [[nodiscard]] std::int64_t silence_limit_ns() const override { return start_.silence_us * 1000; }

 private:
  using Gone = std::function<std::optional<std::string>()>;

  std::unique_ptr<mapping::EventSender> talker(scenario::Phase phase) {
    return std::make_unique<mapping::EventSender>(
        conversation_.mapping, of_.scenario.events, phase, dialogue_, counters_,
        truths_of(of_.truth, of_.flight.per_run_truth), of_.truth.end_us());
  }

  // A target may be silent until an event has configured it. The events begin when the settling time is over
  // and the processes that the bench started have joined the bus.
  Result<void> talk_before(Link& link, std::int64_t settled_ns, const Gone& gone) {
    const bool talks = std::ranges::any_of(of_.scenario.events, [](const scenario::Event& one) {
      return one.when == scenario::Event::When::start;
    });
    if (!talks) return {};
    const std::int64_t limit_ns = std::max(settled_ns, link.now_ns() + find_limit_ns);
    while (link.now_ns() < settled_ns || absent()) {
      if (link.drain() == LinkState::down || gone() || link.now_ns() >= limit_ns)
        return {};  // found again below
      link.wait_until(link.now_ns() + poll_ns);
    }
    return talk(link, scenario::Phase::before, gone);
  }

  // Sends the events of a phase that has no schedule.
  Result<void> talk(Link& link, scenario::Phase phase, const Gone& gone) {
    const std::int64_t start_ns = link.now_ns();
    const auto now_us = [&] { return (link.now_ns() - start_ns) / 1000; };
    Schedule schedule({}, talker(phase));
    schedule.set_clock(now_us);
    const Attached attached(link, schedule);
    while (schedule.due_us() != nodes::never_us) {
      if (link.drain() == LinkState::down)
        return failure(fmt::format("bus '{}': gone before the run", link.port().name()));
      if (const auto why = gone()) return failure(fmt::format("{} before the run", *why));
      const std::int64_t due_us = schedule.due_us();
      if (due_us == nodes::never_us) break;
      if (now_us() < due_us) {
        link.wait_until(std::min(start_ns + due_us * 1000, link.now_ns() + poll_ns));
        continue;
      }
      for (const Frame& frame : schedule.take()) {
        if (link.send(frame, find_limit_ns) != LinkState::up)
          return failure(fmt::format("bus '{}': takes no frame", link.port().name()));
      }
    }
    return {};
  }

  [[nodiscard]] bool absent() const { return of_.others.count().value_or(of_.programs) < of_.programs; }
  [[nodiscard]] bool joined() const { return of_.programs > 0 && of_.others.count() && !absent(); }
  [[nodiscard]] std::string complaint(const Link& link, const MappedWatch& watch,
                                      const Strangers& strangers) const {
    if (absent() && of_.others.complete)
      return fmt::format("target on '{}': its process has not joined the bus within 5 s", link.port().name());
    std::vector<std::string> names;
    for (const mapping::Hear& hear : conversation_.mapping.hears) {
      if (!hear.answers && !watch.heard_from().contains(hear.target)) names.push_back(hear.of.message->name);
    }
    return fmt::format("target on '{}': none of {} within 5 s; {}", link.port().name(),
                       fmt::join(names, ", "), strangers.to_text());
  }

  Setting of_;
  scenario::OwnStart start_;
  mapping::Conversation conversation_;
  mapping::Places places_;
  mapping::Dialogue dialogue_;
  mapping::Counters counters_;
  std::optional<Attached> following_;  // the dialogue, from the configuration on
};

}  // namespace

Result<std::unique_ptr<Dialect>> mapped_dialect(const Setting& setting) {
  const auto& mapping = dynamic_cast<const mapping::Mapping&>(*setting.scenario.binding);
  if (setting.in_process)
    return failure(
        "the device in this process speaks the project's contract, expected a bus and --target for a "
        "scenario with a mapping");
  if (setting.virtual_time && !mapping.answers_by_name)
    return failure(
        fmt::format("{}: no message of the target repeats what it answers, so virtual time would not "
                    "know when to go on; expected [hear.echo], or real time",
                    scenario::to_text(mapping.files)));
  return std::make_unique<MappedDialect>(setting, mapping);
}

}  // namespace canhil::drive
