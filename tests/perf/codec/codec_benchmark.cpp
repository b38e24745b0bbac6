// Measures the time that the codecs need, in nanoseconds. Compare only figures of the same run, because other
// programs use the machine too.
#include <benchmark/benchmark.h>

#include "dbc/parser/codec.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/parser/plan.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"
#include "perf_messages/four_signals.hpp"

namespace canhil {
namespace {

using messages::SlaveImuDeltaTheta;
using perf_messages::FourSignals;
using perf_messages::FourSignalsBig;

template <class Message>
void unpack(benchmark::State& state) {
  std::array<std::uint8_t, Message::size> bytes{0x12, 0x34, 0x56, 0x78, 0x9A, 0x1C, 0x2E, 0x30};
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(bytes);
    Message message = Message::unpack(bytes);
    benchmark::DoNotOptimize(message);
  }
}
BENCHMARK(unpack<SlaveImuDeltaTheta>);
BENCHMARK(unpack<FourSignals>);
BENCHMARK(unpack<FourSignalsBig>);

template <class Message>
void pack(benchmark::State& state) {
  std::array<std::uint8_t, Message::size> bytes{0x12, 0x34, 0x56, 0x78, 0x9A, 0x1C, 0x2E, 0x30};
  Message message = Message::unpack(bytes);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(message);
    message.pack(bytes);
    benchmark::DoNotOptimize(bytes);
  }
}
BENCHMARK(pack<SlaveImuDeltaTheta>);
BENCHMARK(pack<FourSignals>);
BENCHMARK(pack<FourSignalsBig>);

void protect(benchmark::State& state) {
  std::array<std::uint8_t, 8> bytes{0x12, 0x34, 0x56, 0x78, 0x9A, 0x1C, 0x2E, 0x30};
  std::uint8_t counter = 0;
  for ([[maybe_unused]] auto _ : state) {
    e2e::protect(bytes, SlaveImuDeltaTheta::info.e2e_data_id, counter);
    counter = e2e::next(counter);
    benchmark::DoNotOptimize(bytes);
  }
}
BENCHMARK(protect);

void pack_and_protect_a_frame(benchmark::State& state) {
  SlaveImuDeltaTheta message{
      .delta_theta_x_rad = 0.01, .delta_theta_y_rad = -0.02, .delta_theta_z_rad = 0.003};
  std::uint8_t counter = 0;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(message);
    Frame frame = to_frame(message, counter);
    counter = e2e::next(counter);
    benchmark::DoNotOptimize(frame);
  }
}
BENCHMARK(pack_and_protect_a_frame);

void check_and_unpack_a_frame(benchmark::State& state) {
  std::array<Frame, e2e::counter_period> frames;
  for (std::uint8_t i = 0; i < e2e::counter_period; ++i) frames[i] = to_frame(SlaveImuDeltaTheta{}, i);
  e2e::Receiver receiver;
  std::uint8_t counter = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Frame& frame = frames[counter];
    auto check = receiver.check(frame.payload(), SlaveImuDeltaTheta::info.e2e_data_id);
    auto message = from_frame<SlaveImuDeltaTheta>(frame);
    benchmark::DoNotOptimize(check);
    benchmark::DoNotOptimize(message);
    counter = e2e::next(counter);
  }
}
BENCHMARK(check_and_unpack_a_frame);

dbc::Message at_run_time(std::string_view name) {
  const auto database = dbc::read_file(SOURCE_DIR "/tests/perf/codec/four_signals.dbc");
  return *dbc::find_message(database.value(), name);
}

// Decodes a frame to signals with names. Each call prepares the plan of the message again.
void decode_by_name(benchmark::State& state) {
  const dbc::Message message = at_run_time("FourSignals");
  const std::array<std::uint8_t, 8> bytes{0x12, 0x34, 0x56, 0x78, 0x9A, 0x1C, 0x2E, 0x30};
  for ([[maybe_unused]] auto _ : state) {
    auto signals = dbc::decode(message, bytes);
    benchmark::DoNotOptimize(signals);
  }
}
BENCHMARK(decode_by_name);

void decode_by_plan(benchmark::State& state, std::string_view name) {
  const dbc::MessagePlan plan(at_run_time(name));
  std::array<std::uint8_t, 8> bytes{0x12, 0x34, 0x56, 0x78, 0x9A, 0x1C, 0x2E, 0x30};
  std::array<double, 4> values{};
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(bytes);
    auto done = plan.decode(bytes, values);
    benchmark::DoNotOptimize(done);
    benchmark::DoNotOptimize(values);
  }
}
BENCHMARK_CAPTURE(decode_by_plan, FourSignals, "FourSignals");
BENCHMARK_CAPTURE(decode_by_plan, FourSignalsBig, "FourSignalsBig");

void encode_by_plan(benchmark::State& state, std::string_view name) {
  const dbc::MessagePlan plan(at_run_time(name));
  std::array<std::uint8_t, 8> bytes{0x12, 0x34, 0x56, 0x78, 0x9A, 0x1C, 0x2E, 0x30};
  std::array<double, 4> values{};
  auto done = plan.decode(bytes, values);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(values);
    done = plan.encode(values, bytes);
    benchmark::DoNotOptimize(done);
    benchmark::DoNotOptimize(bytes);
  }
}
BENCHMARK_CAPTURE(encode_by_plan, FourSignals, "FourSignals");
BENCHMARK_CAPTURE(encode_by_plan, FourSignalsBig, "FourSignalsBig");

}  // namespace
}  // namespace canhil
