// Tests the device and its estimators with arbitrary input. The first bytes of the input select estimators,
// algorithm and parameters; then the fuzzer performs the handshake and starts the estimators. Each further
// step either advances the time or sends a frame that the input defines. While the time advances, sensors
// report a plausible flight; the input delays, drops or repeats the sensors' frames, or inverts bits in them.
// Therefore the device accepts most frames (counters and CRCs are valid, groups are complete), and most bytes
// of the input have an effect. (A custom mutator, the usual alternative, would have to repair checksums after
// every mutation, and could not keep sensors plausible over a hundred steps.)
//
// Conditions: the device does not crash; it sends only complete groups of its own messages, with consecutive
// counters; its attitude is always a valid rotation; after a reset it gives the same answers to the same
// frames, bit for bit.
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "messages/canhil.hpp"
#include "tests/fuzz/reception_bench.hpp"

namespace {

using canhil::Frame;
using canhil::MessageInfo;
using canhil::fuzz::Script;
using canhil::fuzz::Spoil;
using canhil::messages::all_messages;
using namespace canhil::messages;

void expect(bool holds) {
  if (!holds) std::abort();
}

struct Choice {
  Estimator estimator;
  Algorithm algorithm;
  std::int64_t period_us;
};
constexpr bool is_inertial(const Choice& choice) {
  return choice.estimator == Estimator::transfer_alignment ||
         choice.estimator == Estimator::inflight_alignment;
}
constexpr std::array choices{
    Choice{Estimator::transfer_alignment, Algorithm::kalman, 10'000},
    Choice{Estimator::transfer_alignment, Algorithm::robust_h2, 10'000},
    Choice{Estimator::inflight_alignment, Algorithm::ekf, 10'000},
    Choice{Estimator::inflight_alignment, Algorithm::ukf, 10'000},
    Choice{Estimator::inflight_alignment, Algorithm::sin_cos, 10'000},
    Choice{Estimator::los_rate, Algorithm::kalman, 5'000},
    Choice{Estimator::los_rate, Algorithm::switched_table, 5'000},
    Choice{Estimator::los_rate, Algorithm::combined, 5'000},
    Choice{Estimator::los_rate, Algorithm::low_pass, 5'000},
    Choice{Estimator::wind, Algorithm::ekf, 20'000},
    Choice{Estimator::wind, Algorithm::h_infinity, 20'000},
    Choice{Estimator::wind, Algorithm::adaptive_q, 20'000},
};

// The answers of the device. Each answer is checked against the DBC and against the answers before it.
class Answers {
 public:
  void take(std::span<const Frame> answers) {
    for (const Frame& answer : answers) {
      const auto message = std::ranges::find(all_messages, answer.id, &MessageInfo::id);
      expect(message != all_messages.end() && message->sender == "Target");
      expect(answer.size == message->size && !answer.fd);
      expect(answer.data[0] == canhil::e2e::crc(answer.payload(), message->e2e_data_id));
      const std::uint8_t counter = canhil::e2e::counter(answer.payload());
      std::uint8_t& last = last_[static_cast<std::size_t>(message - all_messages.begin())];
      expect(counter == 0 || counter == canhil::e2e::next(last));  // a reset or start sets counters to 0
      last = counter;
      if (answer.id == AlignAttitude::info.id)
        expect_pitch(canhil::from_frame<AlignAttitude>(answer).pitch_deg);
      if (answer.id == FixAttitude::info.id) expect_pitch(canhil::from_frame<FixAttitude>(answer).pitch_deg);
      all_.push_back(answer);
    }
    expect_whole_groups();
  }
  [[nodiscard]] const std::vector<Frame>& all() const { return all_; }

 private:
  // The device must not send NaN. Packing would convert NaN to the smallest angle of the signal, -180 deg.
  static void expect_pitch(double pitch_deg) { expect(std::abs(pitch_deg) < 90.01); }
  // All messages of a group must have been sent equally often. They are neighbours in the list all_messages.
  void expect_whole_groups() const {
    for (std::size_t i = 1; i < all_messages.size(); ++i) {
      const bool together = all_messages[i].sender == "Target" && !all_messages[i].sample_group.empty() &&
                            all_messages[i].sample_group == all_messages[i - 1].sample_group;
      if (together) expect(last_[i] == last_[i - 1]);
    }
  }

  std::array<std::uint8_t, all_messages.size()> last_{};
  std::vector<Frame> all_;
};

// Sets a parameter of the estimator to a value that is usually within the parameter's range.
void set_parameter(auto& bench, const canhil::target::Device& device, Estimator estimator, Script& script) {
  struct Known {
    Parameter parameter;
    canhil::target::ParameterRange range;
  };
  static const auto known = [&] {
    std::array<std::vector<Known>, 8> of;
    for (const Choice& choice : choices) {
      auto& list = of[static_cast<std::size_t>(choice.estimator)];
      if (!list.empty()) continue;
      for (int number = 0; number < 256; ++number) {
        const auto parameter = static_cast<Parameter>(number);
        if (const auto range = device.range(choice.estimator, parameter)) list.push_back({parameter, *range});
      }
    }
    return of;
  }();
  const std::uint8_t which = script.byte(), how = script.byte();
  const auto& list = known[static_cast<std::size_t>(estimator)];
  if (which == 0xFF || list.empty()) {  // sets any parameter to any value
    float value = 0;
    const auto bytes = script.bytes(sizeof value);
    std::memcpy(&value, bytes.data(), bytes.size());
    return bench.set(static_cast<Parameter>(how), value);
  }
  const auto& [parameter, range] = list[which % list.size()];
  const double part = how / 255.0;
  const double least = range.minimum > 0 ? range.minimum : range.maximum * 1e-9;
  double value = how == 0 ? range.minimum : least * std::pow(range.maximum / least, part);
  if (range.whole) value = range.minimum + how % static_cast<int>(range.maximum - range.minimum + 1);
  bench.set(parameter, value);
}

// Sends the device a frame that the input defines completely.
void feed_any(auto& bench, std::array<std::uint8_t, all_messages.size()>& counters, Script& script) {
  enum : std::uint8_t { unprotected = 1, foreign_id = 2, shortened = 4, is_fd = 8 };
  const std::size_t index = script.byte() % all_messages.size();
  const std::uint8_t flags = script.byte();
  const MessageInfo& message = all_messages[index];
  Frame frame{.id = (flags & foreign_id) != 0 ? message.id ^ 1U : message.id, .size = message.size};
  frame.fd = (flags & is_fd) != 0;
  if ((flags & shortened) != 0) frame.size = static_cast<std::uint8_t>((flags >> 4U) % (message.size + 1));
  std::ranges::copy(script.bytes(frame.size), frame.data.begin());
  if ((flags & unprotected) == 0 && frame.size >= 2) {
    counters[index] = canhil::e2e::next(counters[index]);
    canhil::e2e::protect(std::span(frame.data).first(frame.size), message.e2e_data_id, counters[index]);
  }
  bench.feed(frame);
}

void run(canhil::target::Device& device, Script& script, std::vector<Frame>& fed, Answers& answers,
         std::uint8_t header) {
  canhil::fuzz::Bench bench([&](const Frame& frame) {
    fed.push_back(frame);
    answers.take(device.receive(frame));
  });
  enum : std::uint8_t { air_known = 1, gps = 2, lockstep = 4 };
  std::array<Choice, 2> chosen{};
  chosen.fill(choices[script.byte() % choices.size()]);
  std::size_t running = 1;
  bench.lockstep = (header & lockstep) != 0;
  if (const std::uint8_t second = script.byte(); second < choices.size()) chosen[running++] = choices[second];
  for (std::size_t i = 0; i < running; ++i) {
    bench.command(i == 0 ? Command::reset : Command::add, chosen[i].estimator, chosen[i].algorithm);
    if (chosen[i].estimator == Estimator::inflight_alignment)
      bench.set(Parameter::aiding, (header & gps) != 0 ? 1 : 0);
    for (int left = script.byte() % 8; left > 0; --left)
      set_parameter(bench, device, chosen[i].estimator, script);
    if ((header & air_known) != 0) bench.initialise_air({});
    bench.initialise({});
  }
  bench.command(Command::start, chosen[0].estimator, chosen[0].algorithm);

  std::array<std::uint8_t, all_messages.size()> counters{};
  constexpr int most_samples = 150;  // so that an execution takes only a few milliseconds
  for (int samples = 0; !script.over() && samples < most_samples;) {
    const std::uint8_t what = script.byte();
    const Choice& of = chosen[(what >> 3U) % running];
    switch (what % 8) {
      case 0:
      case 1:
      case 2: {  // the flight continues; the input can change the first sample, but not the others
        constexpr std::array repeats{1, 4, 16, 64};
        const int count = repeats[(what >> 4U) % 4];
        const bool aided = what % 8 != 0;
        const std::int64_t interval_us = what % 8 == 2 ? of.period_us / 2 : of.period_us;
        Spoil spoil = what < 0x80 ? Spoil{} : Spoil::read(script);
        for (int i = 0; i < count; ++i, ++samples) {
          bench.t_us += interval_us;
          bench.sync();
          for (std::size_t k = 0; k < running; ++k) {
            if (aided)
              bench.aid(chosen[k].estimator, k == 0 ? spoil : Spoil{}, bench.t_us, (header & gps) != 0);
            if (k == 0 || !is_inertial(chosen[0]) || !is_inertial(chosen[k]))  // two alignments share one IMU
              bench.drive(chosen[k].estimator, spoil, interval_us);
          }
          spoil = {};
        }
        break;
      }
      case 3: {  // an aiding measurement that is valid before or after the present time
        const std::int64_t lead_us = static_cast<std::int8_t>(script.byte()) * std::int64_t{10'000};
        bench.aid(of.estimator, what < 0x80 ? Spoil{} : Spoil::read(script), bench.t_us + lead_us,
                  (header & gps) != 0);
        ++samples;
        break;
      }
      case 4: {  // time passes without samples
        const std::int64_t gap = script.byte();
        bench.t_us += gap * gap * 100;
        bench.sync();
        break;
      }
      case 5:
        feed_any(bench, counters, script);
        break;
      case 6:
        set_parameter(bench, device, of.estimator, script);
        break;
      case 7: {
        const std::uint8_t command = script.byte();
        const Choice& other = choices[script.byte() % choices.size()];
        if (command < 0x40) {
          bench.initialise(Spoil::read(script));
        } else if (command < 0x60) {
          bench.initialise_air(Spoil::read(script));
        } else {
          bench.command(static_cast<Command>(command % 8), other.estimator, other.algorithm);
        }
        break;
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Script script({data, size});
  canhil::target::Device device;
  std::vector<Frame> fed;
  Answers answers;
  const std::uint8_t header = script.byte();
  run(device, script, fed, answers, header);
  if (header < 0x80) return 0;
  // Feeds the same frames again. The first of them is the reset.
  std::size_t next = 0;
  for (const Frame& frame : fed) {
    for (const Frame& answer : device.receive(frame)) expect(answer == answers.all()[next++]);
  }
  expect(next == answers.all().size());
  return 0;
}
