// What guards hil-target's code itself: the means of all signals that it answers in four flights. The suites
// compare other targets with this code, so they cannot notice that it changed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <sstream>

#include "bench/accept/profile.hpp"
#include "bench/accept/reference.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/session.hpp"
#include "tests/own_folder.hpp"

namespace canhil::accept {
namespace {

std::string read(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void fly(const std::string& name, std::string_view bus, Answers& answers) {
  const auto scenario = scenario::parse(read(fmt::format("{}/bench/flights/{}.toml", SOURCE_DIR, name)),
                                        name + ".toml", drive::contract());
  EXPECT_TRUE(scenario) << scenario.error().message;
  drive::Options options;
  options.bus = drive::BusName(std::string(bus));
  options.onlookers = {&answers};
  const std::atomic<bool> stop = false;
  const auto run = drive::run(*scenario, options, stop, [](std::int64_t) {});
  EXPECT_TRUE(run) << run.error().message;
}

// One line for each signal: how often it came, its mean, and by how much rounding its inputs changes this
// mean.
std::string lines_of(const std::string& flight) {
  Answers rounded, unrounded;
  fly(flight, drive::in_process_bus, rounded);
  fly(flight, drive::unrounded_bus, unrounded);
  std::string text;
  for (const ReferenceMessage& message : make_reference(rounded, unrounded, 0)) {
    for (std::size_t s = 0; s < message.signals.size(); ++s)
      text += fmt::format("{},{},{},{},{:.15g},{:.3g}\n", flight, message.name, message.signals[s],
                          message.count, message.mean[s], message.mean_rounding[s]);
  }
  return text;
}

struct Line {
  std::string name;
  std::size_t count = 0;
  double mean = 0, rounding = 0;
};

std::vector<Line> parsed(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    std::size_t at = 0;
    for (int comma = 0; comma < 3; ++comma) at = line.find(',', at) + 1;
    Line one{.name = line.substr(0, at)};
    std::istringstream numbers(line.substr(at));
    char comma = 0;
    numbers >> one.count >> comma >> one.mean >> comma >> one.rounding;
    lines.push_back(std::move(one));
  }
  return lines;
}

TEST(DeviceAnswers, AreThoseOfBefore) {
  const std::string stored = SOURCE_DIR "/tests/data/device_answers.csv";
  std::string now =
      "# flight,message,signal,answers,mean,effect of rounding on the mean: what hil-target's code "
      "answers. CONTRIBUTING.md says how to replace this file.\n";
  for (const char* flight : {"transfer_alignment_quick", "inflight_quick", "los_quick", "wind_recommended"})
    now += lines_of(flight);
  const std::string written = test::own_folder() + "/device_answers.csv";
  std::ofstream(written) << now;
  const std::vector<Line> is = parsed(now), was = parsed(read(stored));
  ASSERT_EQ(is.size(), was.size()) << "new: " << written << ", before: " << stored;
  for (std::size_t i = 0; i < is.size(); ++i) {
    EXPECT_EQ(is[i].name, was[i].name);
    EXPECT_EQ(is[i].count, was[i].count) << is[i].name;
    // Another compiler may round differently, by at most what rounded inputs change.
    EXPECT_NEAR(is[i].mean, was[i].mean, was[i].rounding + 1e-9 * std::abs(was[i].mean) + 1e-12)
        << is[i].name << "; new: " << written << ", before: " << stored;
  }
}

}  // namespace
}  // namespace canhil::accept
