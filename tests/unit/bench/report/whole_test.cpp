// A report that was truncated or edited is rejected, and the error names the wrong key.
#include "bench/report/whole.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "bench/report/page.hpp"
#include "tests/own_folder.hpp"
#include "tests/unit/bench/report/finished_run.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;

std::string why(const std::function<void(Json&)>& edit) {
  Json report = document(scenario_of(), run_of());
  edit(report);
  return why_not_whole(report);
}

TEST(WholeReport, OfARunAndOfVirtualTime) {
  EXPECT_EQ(why([](Json&) {}), "");
  EXPECT_EQ(why_not_whole(document(scenario_of(), run_on_a_wire())), "");
  drive::Run run = run_of();
  run.clock = drive::ClockKind::lockstep;
  run.timing_unfit = "virtual time";
  EXPECT_EQ(why_not_whole(document(scenario_of(), run)), "");
}

TEST(WholeReport, AKeyThatIsMissingOrOfAnotherKind) {
  EXPECT_EQ(why([](Json& r) { r.erase("reason"); }), "key 'reason' is missing, expected a whole report");
  EXPECT_EQ(why([](Json& r) { r["provenance"].erase("scenario_hash"); }),
            "key 'provenance.scenario_hash' is missing, expected a whole report");
  EXPECT_EQ(why([](Json& r) { r["provenance"] = nullptr; }), "key 'provenance': is null, expected a table");
  EXPECT_EQ(why([](Json& r) { r["checks"] = Json::object(); }), "key 'checks': is {}, expected a list");
  EXPECT_EQ(why([](Json& r) { r["checks"][1] = 5; }), "key 'checks[1]': is 5, expected a table");
  EXPECT_EQ(why([](Json& r) { r["checks"][0]["name"] = 7; }), "key 'checks[0].name': is 7, expected text");
  EXPECT_EQ(why([](Json& r) { r["latency_s"] = Json::array(); }), "key 'latency_s': is [], expected a table");
  EXPECT_EQ(why([](Json& r) { r["timing"]["judged"] = "yes"; }),
            "key 'timing.judged': is \"yes\", expected true or false");
}

TEST(WholeReport, NumbersOfACheckThatCannotBe) {
  const auto wrong = [](const std::function<void(Json&)>& edit) {
    return why([&](Json& r) { edit(r["checks"][0]); });
  };
  const Json whole = Json::parse(R"({"value": 2, "upper": 2.5, "upper_inclusive": false, "unit": "mrad",
      "margin": 0.2, "count": 5, "from_s": 0, "to_s": 1, "worst_at_s": 0.5})");
  EXPECT_EQ(wrong([&](Json& check) { check.update(whole); }), "");
  for (const auto& [key, value] : whole.items()) {
    const std::string name = key;
    EXPECT_THAT(wrong([&](Json& check) {
                  check.update(whole);
                  check[name] = Json::array();
                }),
                testing::StartsWith("key 'checks[0]." + name + "': is [], expected "));
  }
  EXPECT_EQ(wrong([&](Json& check) { check["lower"] = 1; }),
            "key 'checks[0].lower_inclusive' is missing, expected a whole report");
  EXPECT_EQ(wrong([](Json& check) { check["time_to_go_s"] = {1}; }),
            "key 'checks[0].time_to_go_s': is [1], expected [least, most]");
}

TEST(WholeReport, ABitRateThatCannotBe) {
  Json report = document(scenario_of(), run_on_a_wire());
  report["wire"]["bitrate_bitps"] = 1e308;  // no conversion to an integer is defined for this value
  EXPECT_EQ(why_not_whole(report),
            "key 'wire.bitrate_bitps': is 1e+308, expected a whole number of at least 0");
}

TEST(WholeReport, ADistributionThatCannotBe) {
  const auto wrong = [](const std::function<void(Json&)>& edit) {
    return why([&](Json& r) { edit(r["latency_s"]["AlignVelocityD"]); });
  };
  const std::string at = "key 'latency_s.AlignVelocityD.";
  const auto with_buckets = [&](const Json& buckets) {
    return wrong([&](Json& d) { d["buckets_us"] = buckets; });
  };
  const std::string whole = "expected a whole number of at least 0";
  EXPECT_EQ(with_buckets({{1e300, 200}}), at + "buckets_us[0][0]': is 1e+300, " + whole);
  EXPECT_EQ(with_buckets({{5, -3}}), at + "buckets_us[0][1]': is -3, " + whole);
  EXPECT_EQ(with_buckets({{-5, 200}}), at + "buckets_us[0][0]': is -5, " + whole);
  EXPECT_EQ(with_buckets({{5.5, 200}}), at + "buckets_us[0][0]': is 5.5, " + whole);
  EXPECT_EQ(with_buckets(Json::parse("[[5]]")), at + "buckets_us[0]': is [5], expected [from us, count]");
  EXPECT_EQ(with_buckets({{5, 100}, {5, 100}}),
            at + "buckets_us[1]': is [5,100], expected a bucket from 6 to 10000000 us, in ascending order");
  EXPECT_EQ(
      with_buckets({{10'000'001, 200}}),
      at + "buckets_us[0]': is [10000001,200], expected a bucket from 0 to 10000000 us, in ascending order");
  EXPECT_EQ(
      with_buckets({{5, 18446744073709551615U}}),
      at + "buckets_us[0]': is [5,18446744073709551615], expected no more than the 200 of 'count' in all");
  EXPECT_EQ(with_buckets({{5, 199}}), at + "buckets_us' holds 199 of 200, expected as many as 'count'");
  EXPECT_EQ(wrong([](Json& d) { d["p50"] = "NaN"; }), at + "p50': is \"NaN\", expected a number");
  EXPECT_EQ(wrong([](Json& d) { d["p50"] = -1; }),
            at + "p50': is -1, expected at least 0.000201, as the one before it");
  EXPECT_EQ(wrong([](Json& d) { d["count"] = -5; }), at + "count': is -5, " + whole);
  EXPECT_EQ(wrong([](Json& d) { d["closes_group"] = 1; }),
            at + "closes_group': is 1, expected true or false");
}

TEST(WholeReport, IsAskedForWhereAFileIsRead) {
  const std::string path = test::own_folder() + "/canhil_not_whole.json";
  const auto said = [&](const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
    const auto read = read_document(path);
    std::remove(path.c_str());
    return read ? "" : read.error().message;
  };
  const std::string text = json(scenario_of(), run_of());
  EXPECT_EQ(said(text), "");
  Json torn = Json::parse(text);
  torn.erase("timing");
  EXPECT_EQ(said(torn.dump()), "file '" + path + "': key 'timing' is missing, expected a whole report");
  EXPECT_EQ(said(text + std::string(1, '\0') + "more"),
            "file '" + path + "': is not JSON, expected a report of hil-bench run --json");
}

}  // namespace
}  // namespace canhil::report
