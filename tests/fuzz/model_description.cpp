// Tests the code that reads modelDescription.xml of an FMU. For any text, it must return a description whose
// variables can be set and sized, or one error line.
#include <cstdint>

#include "bench/plant/fmu/description.hpp"
#include "bench/plant/fmu/presets.hpp"
#include "bench/scenario/section.hpp"
#include "tests/fuzz/expect.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace canhil;
  const auto description = plant::fmu::read_description({reinterpret_cast<const char*>(data), size});
  if (!description) {
    fuzz::expect_one_line(description.error().message);
    return 0;
  }
  auto root = scenario::Section::parse("[plant.parameters]\nn = 2\n'A[1,2]' = 0.5\n", "fuzz.toml");
  scenario::Section plant = root.table("plant");
  const auto parameters = plant.optional_table("parameters");
  for (const plant::fmu::Sized& one : read_presets(plant, parameters, *description)) {
    if (!one.start.empty() && one.start.size() != one.count()) std::abort();
  }
  if (const auto error = root.error()) fuzz::expect_one_line(error->message, "fuzz.toml");
  return 0;
}
