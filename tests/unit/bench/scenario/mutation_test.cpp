// Reading any file gives either a scenario within its limits, or one line that names the file.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

/// The quick scenario of the project: it contains most of the grammar.
std::string quick() {
  std::ifstream file(SOURCE_DIR "/bench/flights/transfer_alignment_quick.toml");
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_a_scenario_or_one_line(const std::string& text) {
  const Result<Scenario> result = parse(text, "s.toml", contract);
  if (result) {
    RC_ASSERT(result->duration_us > 0);
    RC_ASSERT(!result->checks.empty());
    RC_ASSERT(result->targets.front().initial_sigma.velocity > 0);
    return;
  }
  const std::string& message = result.error().message;
  RC_ASSERT(message.starts_with("s.toml:"));
  RC_ASSERT(std::ranges::none_of(message, [](char c) { return static_cast<unsigned char>(c) < ' '; }));
}

bool holds(auto property) { return rc::check(property); }

TEST(ScenarioMutations, TheOriginalIsValid) { EXPECT_EQ(error_of(quick()), "no error"); }

TEST(ScenarioMutations, BytesReplacedInsertedRemoved) {
  const std::string original = quick();
  EXPECT_TRUE(holds([&] {
    std::string text = original;
    for (int edits = *rc::gen::inRange(1, 4); edits > 0; --edits) {
      const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
      const auto length = *rc::gen::inRange<std::size_t>(0, 20);
      text.replace(at, length, *rc::gen::string<std::string>());
    }
    expect_a_scenario_or_one_line(text);
  }));
}

TEST(ScenarioMutations, ValuesOfOtherTypesAndSizes) {
  const std::string original = quick();
  EXPECT_TRUE(holds([&] {
    // Chooses any " = " of the file, and replaces the rest of its line by another value.
    std::vector<std::size_t> values;
    for (std::size_t at = original.find(" = "); at != std::string::npos; at = original.find(" = ", at + 1)) {
      values.push_back(at + 3);
    }
    std::string text = original;
    const std::size_t at = *rc::gen::elementOf(values);
    const std::string value = *rc::gen::element<std::string>(
        "1", "-1", "0", "1e308", "-1e308", "nan", "inf", "9223372036854775807", "1e-300", "true", "\"\"",
        "\"\\n\"", "[]", "{}", "[1,2,3]", "[[1],[2]]", "{ a = 1 }", "1979-05-27", "07:32:00", "\"kalman\"",
        "[{},{}]");
    text.replace(at, text.find('\n', at) - at, value);
    expect_a_scenario_or_one_line(text);
  }));
}

TEST(ScenarioMutations, LinesRemovedDoubledSwapped) {
  const std::string original = quick();
  std::vector<std::string> lines;
  std::istringstream stream(original);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  EXPECT_TRUE(holds([&] {
    std::vector<std::string> changed = lines;
    const auto a = *rc::gen::inRange<std::size_t>(0, changed.size());
    const auto b = *rc::gen::inRange<std::size_t>(0, changed.size());
    switch (*rc::gen::inRange(0, 3)) {
      case 0:
        changed[a].clear();
        break;
      case 1:
        changed[a] = changed[b];
        break;
      default:
        std::swap(changed[a], changed[b]);
    }
    std::string text;
    for (const std::string& line : changed) text += line + "\n";
    expect_a_scenario_or_one_line(text);
  }));
}

}  // namespace
}  // namespace canhil::scenario
