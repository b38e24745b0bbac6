// What every frame pays (its protection), and what a start pays (reading the DBC).
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>

#include "dbc/parser/parse.hpp"
#include "dbc/wire/e2e.hpp"

namespace {

void check_frame(benchmark::State& state) {
  std::array<std::uint8_t, 8> data{0, 0, 1, 2, 3, 4, 5, 6};
  canhil::e2e::Receiver receiver;
  canhil::e2e::protect(data, 0x1234, 3);
  for (auto _ : state) {
    benchmark::DoNotOptimize(data);
    benchmark::DoNotOptimize(receiver.check(data, 0x1234));
  }
}
BENCHMARK(check_frame);

void read_dbc(benchmark::State& state) {
  std::ifstream file(SOURCE_DIR "/dbc/canhil.dbc");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (auto _ : state) {
    auto database = canhil::dbc::parse(text, "canhil.dbc");
    if (!database) {
      state.SkipWithError(database.error().message.c_str());
      break;
    }
    benchmark::DoNotOptimize(database);
  }
}
BENCHMARK(read_dbc)->Unit(benchmark::kMicrosecond);

}  // namespace
