#include "bench/live/message.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "bench/quantities/list.hpp"

namespace canhil::live {
namespace {

using Json = nlohmann::json;

Snapshot snapshot(std::size_t points) {
  report::Series series{.estimator = "any",
                        .name = std::string(quantities::attitude_heading.name),
                        .quantity = "heading error",
                        .unit = "mrad"};
  for (std::size_t i = 0; i < points; ++i)
    series.points.push_back({.t_s = static_cast<double>(i), .low = -1, .high = 1, .sigma = 0.5});
  Snapshot all{.flight = Flight{.title = "a flight", .duration_s = 20}};
  all.flight->series.push_back(std::move(series));
  return all;
}
Json series_of(const std::string& message) { return Json::parse(message)["flight"]["series"][0]; }

TEST(LiveMessage, SaysWhatIsNew) {
  Sent sent;
  EXPECT_EQ(series_of(next_message(snapshot(3), sent))["from"], 0);
  // The last point that was sent is sent again, because it may have changed.
  const Json next = series_of(next_message(snapshot(5), sent));
  EXPECT_EQ(next["from"], 2);
  EXPECT_EQ(next["t_s"], (std::vector<double>{2, 3, 4}));
  EXPECT_EQ(series_of(whole_message(snapshot(5)))["t_s"].size(), 5U);
}

TEST(LiveMessage, SaysAllOfTheEnd) {
  Sent sent;
  next_message(snapshot(5), sent);
  Snapshot end = snapshot(5);
  end.flight->outcome = checks::Outcome::pass;
  const Json message = Json::parse(next_message(end, sent));
  EXPECT_EQ(message["flight"]["series"][0]["from"], 0);
  EXPECT_EQ(message["flight"]["outcome"], "pass");
  EXPECT_EQ(message["over"], true);
}

TEST(LiveMessage, HoldsWhatIsNotANumber) {
  Snapshot odd = snapshot(1);
  odd.flight->series[0].points[0].low = std::numeric_limits<double>::quiet_NaN();
  odd.flight->series[0].points[0].sigma.reset();
  odd.flight->bus = "\xff";
  const Json message = Json::parse(whole_message(odd));
  EXPECT_TRUE(message["flight"]["series"][0]["low"][0].is_null());
  EXPECT_TRUE(message["flight"]["series"][0]["sigma"][0].is_null());
}

TEST(LiveMessage, KeepsTheLatestOfABatch) {
  Batch batch{.title = "many", .of = "runs"};
  for (int i = 0; i < 1000; ++i) batch.add({.name = std::to_string(i), .result = "completed"});
  EXPECT_EQ(batch.latest.size(), Batch::most_latest);
  EXPECT_EQ(batch.latest.front().name, "999");
  const Json message = Json::parse(whole_message({.batch = batch}));
  EXPECT_EQ(message["batch"]["latest"].size(), Batch::most_latest);
}

}  // namespace
}  // namespace canhil::live
