#include "bench/live/screen.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "bench/quantities/list.hpp"

namespace canhil::live {
namespace {

Snapshot full_snapshot() {
  Snapshot snapshot{
      .flight = Flight{.title = "a flight over M\xc3\xbcnchen\x1b[2J",
                       .t_s = 7,
                       .duration_s = 20,
                       .checks = {{.name = "one", .outcome = checks::Outcome::fail, .measured = "2 mrad"},
                                  {.name = "two"}}}};
  for (int i = 0; i < 30; ++i) {
    snapshot.flight->series.push_back({.estimator = "any",
                                       .name = std::string(quantities::attitude_heading.name),
                                       .quantity = "error " + std::to_string(i),
                                       .unit = "mrad",
                                       .points = {{.t_s = 7, .low = -1e300, .high = 1e300, .sigma = 0.4}}});
    snapshot.flight->timing.push_back({.message = "Answer", .count = 9, .p50_us = 120, .p99_us = 340});
  }
  return snapshot;
}

TEST(LiveScreen, FitsEverySize) {
  for (const std::size_t rows : {0U, 1U, 2U, 5U, 24U, 100U}) {
    for (const std::size_t columns : {1U, 10U, 40U, 80U, 200U}) {
      const auto lines = screen_of(full_snapshot(), rows, columns, false);
      EXPECT_LE(lines.size(), rows);
      for (const ScreenLine& line : lines) {
        const auto characters = std::ranges::count_if(
            line.text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
        EXPECT_LE(static_cast<std::size_t>(characters), columns);
      }
    }
  }
}

TEST(LiveScreen, ShowsTheMostImportantFirst) {
  const auto lines = screen_of(full_snapshot(), 60, 80, true);
  EXPECT_NE(lines[0].text.find("running, paused: a flight over M\xc3\xbcnchen\\x1b[2J"), std::string::npos);
  EXPECT_NE(lines[1].text.find("7.0 / 20 s"), std::string::npos);
  std::string all;
  for (const ScreenLine& line : lines) all += line.text + '\n';
  EXPECT_NE(all.find("0 passed, 1 failed, 1 open"), std::string::npos);
  EXPECT_NE(all.find("1.200"), std::string::npos);  // three sigma
  EXPECT_NE(all.find("0.340"), std::string::npos);
}

TEST(LiveScreen, ShowsABatch) {
  Batch batch{
      .title = "many", .of = "runs", .done = 3, .total = 10, .failed = 1, .failed_means = "ended early"};
  batch.add({.name = "run 2", .result = "target silent", .failed = true});
  const auto lines = screen_of({.batch = batch}, 10, 80, false);
  EXPECT_NE(lines[1].text.find("3 / 10 runs"), std::string::npos);
  EXPECT_NE(lines[2].text.find("ended early: 1"), std::string::npos);
}

}  // namespace
}  // namespace canhil::live
