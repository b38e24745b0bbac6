// A target that is correct except for one fault, which the bench must detect. The first argument selects the
// fault.
//   lying_target LIE --bus BUS
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"
#include "target/process/event_loop.hpp"

namespace {

using namespace canhil;
using namespace canhil::messages;

// Changes a frame that the target is about to send. Returns false if the frame must not be sent. `after`:
// frames to send after it.
class Lie {
 public:
  template <class Change>
  Lie(Change change) {
    if constexpr (std::is_invocable_v<Change, Frame&>) {
      change_ = [change](Frame& frame, std::vector<Frame>&) mutable { return change(frame); };
    } else {
      change_ = change;
    }
  }
  bool operator()(Frame& frame, std::vector<Frame>& after) const { return change_(frame, after); }

 private:
  std::function<bool(Frame&, std::vector<Frame>&)> change_;
};

// If the frame carries the message `Message`, replaces the values of the message and keeps its counter.
template <class Message, class Change>
void change(Frame& frame, const Change& values) {
  if (frame.id != Message::info.id) return;
  auto message = from_frame<Message>(frame);
  values(message);
  frame = to_frame(message, e2e::counter(frame.payload()));
}

template <class Change>
void change_every(Frame& frame, const Change& values) {
  [&]<class... Messages>(std::type_identity<std::tuple<Messages...>>) {
    (change<Messages>(frame, values), ...);
  }(std::type_identity<AllMessages>{});
}

template <class Message>
Lie when(const std::function<void(Frame&)>& spoil) {
  return [spoil](Frame& frame) {
    if (frame.id == Message::info.id) spoil(frame);
    return true;
  };
}

// Sends every second answer after the next answer of its group, with changed values. The two answers exchange
// their counters, so that the counters of the messages are in order.
template <class... Messages>
auto late(std::type_identity_t<void (*)(std::tuple<Messages...>&)> spoil = nullptr) {
  struct Held {
    bool holds = false;              // the answer that is being sent is held back
    std::tuple<Messages...> values;  // of the answer that is held back
    std::uint8_t counter = 0;
    std::size_t taken = 0;  // messages of the answer that is being sent
  };
  return [spoil, held = Held{}](Frame& frame, std::vector<Frame>& after) mutable {
    bool send = true;
    const auto take = [&]<class Message>(std::type_identity<Message>) {
      if (frame.id != Message::info.id) return;
      if (held.taken == 0) held.holds = !held.holds;
      held.taken = (held.taken + 1) % sizeof...(Messages);
      send = !held.holds;
      if (held.holds) {
        std::get<Message>(held.values) = from_frame<Message>(frame);
        held.counter = e2e::counter(frame.payload());
        return;
      }
      const std::uint8_t now = e2e::counter(frame.payload());
      frame = to_frame(from_frame<Message>(frame), held.counter);
      if (held.taken != 0) return;
      if (spoil != nullptr) spoil(held.values);
      std::apply([&](const auto&... message) { (after.push_back(to_frame(message, now)), ...); },
                 held.values);
    };
    (take(std::type_identity<Messages>{}), ...);
    return send;
  };
}

/// Changes those messages of this type that the target sends in flight, from the `first` on; the messages
/// before it are counted.
template <class Message, class Change>
Lie from_the(int first, Change values) {
  return [first, values, sent = 0](Frame& frame) mutable {
    change<Message>(frame, [&](Message& message) {
      if constexpr (std::is_same_v<Message, TargetHeartbeat>) {
        if (message.state != TargetState::running) return;
      }
      if (sent++ >= first) values(message);
    });
    return true;
  };
}

void protect(Frame& frame, std::uint8_t counter);

// Sends only some of the answers to the seeker. The counters of the frames have no gap, so the bench sees no
// loss on the bus. `copies`: how often the answer with this number is sent.
Lie answers(const std::function<int(int number)>& copies) {
  return [copies, number = -1, counter = std::uint8_t{0}, group = std::vector<Frame>()](
             Frame& frame, std::vector<Frame>& after) mutable {
    const bool first = frame.id == LosRateEstimate::info.id, last = frame.id == LosRateTarget::info.id;
    if (!first && !last && frame.id != LosRateSigma::info.id) return true;
    if (first) group.clear();
    group.push_back(frame);
    if (!last) return false;
    ++number;
    for (int copy = 0; copy < copies(number); ++copy) {
      for (Frame& one : group) {
        protect(one, counter);
        after.push_back(one);
      }
      counter = e2e::next(counter);
    }
    return false;
  };
}

// Starts the program anew, without a lie, as a board does that resets itself.
std::vector<char*>& arguments() {
  static std::vector<char*> all;
  return all;
}
void reboot() {
  static std::string none = "none";
  std::vector<char*> anew = arguments();
  anew[1] = none.data();
  anew.push_back(nullptr);
  execv("/proc/self/exe", anew.data());
}

std::uint8_t moved(std::uint8_t counter) { return e2e::next(counter); }

void protect(Frame& frame, std::uint8_t counter) {
  e2e::protect({frame.data.data(), frame.size}, find_message(frame.id)->e2e_data_id, counter);
}

const std::map<std::string_view, Lie>& lies() {
  static const std::map<std::string_view, Lie> all{
      {"forgets_losses",
       [](Frame& frame) {
         change<TargetCounters>(frame, [](TargetCounters& message) { message = {}; });
         return true;
       }},
      {"counts_one_loss_more",
       [](Frame& frame) {
         change<TargetCounters>(frame, [](TargetCounters& message) { ++message.frames_lost; });
         return true;
       }},
      {"cause_counter_off_by_one",
       [](Frame& frame) {
         change_every(frame, [](auto& message) {
           if constexpr (requires { message.cause_counter; })
             message.cause_counter = moved(message.cause_counter);
         });
         return true;
       }},
      {"cause_time_off",
       [](Frame& frame) {
         change_every(frame, [](auto& message) {
           if constexpr (requires { message.cause_time_us; }) message.cause_time_us += 5;
         });
         return true;
       }},
      {"no_sigma", [](Frame& frame) { return frame.id != LosRateSigma::info.id; }},
      {"sigma_with_wrong_crc", when<LosRateSigma>([](Frame& frame) { frame.data[0] ^= 1U; })},
      {"sigma_with_another_counter",
       when<LosRateSigma>([](Frame& frame) { protect(frame, moved(e2e::counter(frame.payload()))); })},
      {"heartbeat_with_wrong_crc", when<TargetHeartbeat>([](Frame& frame) { frame.data[0] ^= 1U; })},
      {"heartbeat_with_counter_15", when<TargetHeartbeat>([](Frame& frame) { protect(frame, 15); })},
      {"short_heartbeat", when<TargetHeartbeat>([](Frame& frame) { --frame.size; })},
      {"counter_stands_still", when<TargetCounters>([](Frame& frame) { protect(frame, 3); })},
      {"counters_jump",
       [](Frame& frame) {
         if (find_message(frame.id)->sample_group == LosRateEstimate::info.sample_group)
           protect(frame, static_cast<std::uint8_t>(2 * e2e::counter(frame.payload()) % e2e::counter_period));
         return true;
       }},
      {"other_ids", when<TargetHeartbeat>([](Frame& frame) { frame.id = 0x456; })},
      {"acknowledges_another_parameter",
       [](Frame& frame) {
         change<ParamAck>(frame, [](ParamAck& message) { message.parameter = Parameter::closed_loop; });
         return true;
       }},
      {"late_answers", late<LosRateEstimate, LosRateSigma, LosRateTarget>()},
      {"late_navigation", late<AlignAttitude, AlignVelocityNE, AlignVelocityD>()},
      {"late_fixes", late<FixAttitude, FixVelocityNE, FixVelocityD>()},
      {"late_winds", late<WindVector, WindSpeed, WindSigma, WindCorrelation, WindTrackSigma, WindAirVelocity,
                          messages::WindAttitude, WindInnovation, WindUpdate>()},
      {"late_garbage", late<LosRateEstimate, LosRateSigma, LosRateTarget>(
                           [](std::tuple<LosRateEstimate, LosRateSigma, LosRateTarget>& answer) {
                             std::get<LosRateEstimate>(answer).los_rate_pitch_radps = 3;
                           })},
      {"none", [](Frame&) { return true; }},
      {"counters_stop",
       [sent = 0](Frame& frame) mutable { return frame.id != TargetCounters::info.id || sent++ < 10; }},
      {"counts_fall",
       from_the<TargetCounters>(
           0, [sent = 0](TargetCounters& message) mutable { message.frames_lost = sent++ < 10 ? 77 : 0; })},
      {"idle_in_flight",
       from_the<TargetHeartbeat>(10, [](TargetHeartbeat& message) { message.state = TargetState::idle; })},
      {"numeric_error",
       from_the<TargetHeartbeat>(10, [](TargetHeartbeat& message) { message.error_numeric = 1; })},
      {"another_version",
       from_the<TargetHeartbeat>(10, [](TargetHeartbeat& message) { ++message.version_minor; })},
      {"reboots", from_the<TargetHeartbeat>(10, [](TargetHeartbeat&) { reboot(); })},
      {"always_degraded",
       [](Frame& frame) {
         change<LosRateSigma>(frame, [](LosRateSigma& message) { message.degraded = 1; });
         return true;
       }},
      {"heading_off",
       from_the<AlignAttitude>(0, [](AlignAttitude& message) { message.heading_deg += 0.03; })},
      {"one_answer_in_150", answers([](int number) { return number % 150 == 0 ? 1 : 0; })},
      {"silent_from_600", answers([](int number) { return number < 600 ? 1 : 0; })},
      {"silent_before_900", answers([](int number) { return number < 900 ? 0 : 1; })},
      {"one_answer_missing", answers([](int number) { return number == 700 ? 0 : 1; })},
      {"answers_twice", answers([](int number) { return number % 50 == 0 ? 2 : 1; })},
      {"never_ready",
       [](Frame& frame) {
         change<TargetHeartbeat>(frame, [](TargetHeartbeat& message) { message.state = TargetState::idle; });
         return true;
       }},
  };
  return all;
}

// The port of the target: it changes the frames that the target sends to the bus.
class LyingPort final : public Port {
 public:
  LyingPort(std::unique_ptr<Port> bus, Lie lie) : bus_(std::move(bus)), lie_(std::move(lie)) {}
  SendOutcome send(const Frame& frame) override {
    Frame changed = frame;
    std::vector<Frame> after;
    SendOutcome outcome = lie_(changed, after) ? bus_->send(changed) : SendOutcome::sent;
    for (const Frame& one : after) outcome = bus_->send(one);
    return outcome;
  }
  std::optional<Received> receive() override { return bus_->receive(); }
  [[nodiscard]] int descriptor() const override { return bus_->descriptor(); }
  [[nodiscard]] RoomWait room_wait() const override { return bus_->room_wait(); }
  bool wait_for_frame(std::int64_t deadline_ns) override { return bus_->wait_for_frame(deadline_ns); }
  bool wait_for_room(std::int64_t deadline_ns) override { return bus_->wait_for_room(deadline_ns); }
  [[nodiscard]] bool closed() const override { return bus_->closed(); }
  [[nodiscard]] bool up() const override { return bus_->up(); }
  [[nodiscard]] PortCounters counters() const override { return bus_->counters(); }
  [[nodiscard]] Capabilities capabilities() const override { return bus_->capabilities(); }
  [[nodiscard]] int stamp_clock() const override { return bus_->stamp_clock(); }
  [[nodiscard]] const std::string& name() const override { return bus_->name(); }

 private:
  std::unique_ptr<Port> bus_;
  Lie lie_;
};

int complain(const std::string& what) {
  std::fprintf(stderr, "lying_target: %s\n", what.c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  arguments().assign(argv, argv + argc);
  if (argc < 4 || std::string_view(argv[2]) != "--bus") return complain("expected LIE --bus BUS");
  const auto lie = lies().find(argv[1]);
  if (lie == lies().end()) return complain(std::string("no such lie: ") + argv[1]);
  PortOptions options;
  options.node_name = "lying-target";
  auto bus = open_bus(argv[3], options, BusFormat::classic);
  if (!bus) return complain(bus.error().message);
  LyingPort port(std::move(*bus), lie->second);
  const std::atomic<bool> never = false;
  const auto served = target::serve(port, BusFormat::classic, never);
  return served ? 0 : complain(served.error().message);
}
