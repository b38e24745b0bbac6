// Tests the code that reads a scenario. For any text, it must return a Scenario, or one error line that names
// the file. If the flight is short, the test also prepares a run of the scenario: it computes the truth,
// makes the nodes, and takes their first transmissions.
#include <cstdint>

#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/scenario/commands.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace canhil;

void begin(const scenario::Scenario& scenario) {
  const auto truth = drive::make_truth(scenario);
  if (!truth) return fuzz::expect_one_line(truth.error().message);
  auto flight = drive::make_flight(scenario, *truth, 0);
  if (!flight) return fuzz::expect_one_line(flight.error().message);
  drive::Schedule schedule = drive::make_schedule(scenario, *truth, flight->per_run_truth, 0, true);
  for (int n = 0; n < 50 && schedule.due_us() != nodes::never_us; ++n) schedule.take();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  scenario::forbid_commands();  // a text must not start a program
  static const scenario::DbcVocabulary contract = drive::contract();
  const auto scenario = scenario::parse(text, "fuzz.toml", contract);
  if (!scenario) {
    fuzz::expect_one_line(scenario.error().message, "fuzz.toml:");
  } else if (scenario->duration_us <= 100'000) {
    begin(*scenario);
  }
  return 0;
}
