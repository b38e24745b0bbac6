// Tests the two DBC readers, the strict and the lenient one. For any text, each must return a Database that
// the codec can use, or one error line that states the place of the error in the text.
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "dbc/parser/decimal.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/parser/plan.hpp"
#include "dbc/wire/bits.hpp"

namespace {

using namespace canhil::dbc;

void expect_one_line(const canhil::Error& error) {
  if (!error.message.starts_with("fuzz.dbc:") || error.message.find('\n') != std::string::npos) std::abort();
}

/// Decodes and encodes each message. If the codec accesses bytes outside the frame, a sanitizer detects this.
void expect_usable(const Database& database) {
  for (const Message& message : database.messages) {
    const MessagePlan plan(message);
    std::vector<std::uint8_t> data(plan.size(), 0xFF);
    std::vector<double> values(plan.signals());
    if (!plan.decode(data, values) || !plan.encode(values, data)) std::abort();
    for (const Signal& signal : message.signals) {
      const DecimalConversion conversion(signal);
      if (conversion.text(0).empty() || conversion.text(canhil::wire::mask(signal.length)).empty())
        std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto strict = parse(text, "fuzz.dbc");
  const auto lenient = parse_leniently(text, "fuzz.dbc");
  if (!strict) expect_one_line(strict.error());
  if (!lenient) expect_one_line(lenient.error());
  if (strict && !lenient) std::abort();
  if (lenient) expect_usable(*lenient);
  if (const Inspection other = inspect(text, "shift_jis"); other.database) expect_usable(*other.database);
  return 0;
}
