// The HTML page of a report is complete, is drawn from the JSON alone, and escapes all names.
#include "bench/report/page.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/report/markup.hpp"
#include "bench/report/plot.hpp"
#include "bench/report/run_reports.hpp"
#include "tests/own_folder.hpp"
#include "tests/unit/bench/report/finished_run.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::AllOf;
using testing::AnyOf;
using testing::ContainsRegex;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Pointwise;

std::string page_of(const drive::Run& run) { return html(document(scenario_of(), run)).value(); }

TEST(Page, NeedsNothingOutsideItself) {
  EXPECT_THAT(page_of(run_of()),
              AllOf(Not(HasSubstr("src=")), Not(HasSubstr("url(")), Not(HasSubstr("<link")),
                    Not(HasSubstr("@import")), Not(HasSubstr("style=\""))));
}

// What a CI server's content policy forbids may change only the looks.
TEST(Page, MeansTheSameWithoutItsStyleAndScript) {
  std::string page = page_of(run_of());
  for (const auto& [from, to] : {std::pair("<style>", "</style>"), std::pair("<script>", "</script>")}) {
    const std::size_t at = page.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    page.erase(at, page.find(to) - at);
  }
  EXPECT_THAT(page, HasSubstr("<font class=\"no\" color=\"#a32a00\">&#10007; fail</font>"));
  for (std::size_t at = page.find("<table"); at != std::string::npos; at = page.find("<table", at + 1))
    EXPECT_THAT(page.substr(at, page.find('>', at) - at), HasSubstr("border=\"1\""));
  for (const char* element : {"<path ", "<circle "}) {
    for (std::size_t at = page.find(element); at != std::string::npos; at = page.find(element, at + 1))
      EXPECT_THAT(page.substr(at, page.find('>', at) - at),
                  AnyOf(HasSubstr("stroke=\"var(--"), HasSubstr("fill=\"var(--")));
  }
}

TEST(Page, SaysVerdictReasonChecksAndRequirement) {
  const std::string page = page_of(run_of());
  EXPECT_THAT(page, AllOf(HasSubstr("1 of 2 checks failed"), HasSubstr("REQ-7"), HasSubstr("late &amp; slow"),
                          HasSubstr("&#10007; fail</font></b>"), HasSubstr("? not measured")));
}

TEST(Page, ShowsLatencyJitterErrorsAndProvenance) {
  const std::string page = page_of(run_of());
  EXPECT_THAT(page, AllOf(HasSubstr("<h3>AlignVelocityD</h3>"), HasSubstr("Deviation of its period"),
                          HasSubstr("attitude error about north"), HasSubstr("normalised innovation squared"),
                          HasSubstr("velocity error down"), HasSubstr("cpu_model"), HasSubstr("dbc_hash")));
}

TEST(Page, EveryPictureIsWellFormedAndFinite) {
  const std::string page = page_of(run_of());
  int pictures = 0;
  for (auto at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) {
    if (page.compare(at, 8, "<svg x=\"") == 0) continue;  // the curves, within a picture
    std::size_t end = page.find("</svg>", at) + 6;
    if (page.substr(at, end - at).find("<svg x=\"") != std::string::npos) end = page.find("</svg>", end) + 6;
    const std::string picture = page.substr(at, end - at);
    std::istringstream text(picture);
    boost::property_tree::ptree xml;
    EXPECT_NO_THROW(read_xml(text, xml)) << picture;
    EXPECT_THAT(picture, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
    ++pictures;
  }
  EXPECT_GE(pictures, 10);
}

TEST(Page, IsTheSameFromTheFileAsFromTheRun) {
  const std::string path = test::own_folder() + "/canhil_page_test.json";
  const drive::Run run = run_of();
  std::ofstream(path) << json(scenario_of(), run);
  const auto read = read_document(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(html(*read).value(), page_of(run));
}

TEST(Page, OfVirtualTimeHasNoLatency) {
  drive::Run run = run_of();
  run.clock = drive::ClockKind::lockstep;
  run.timing_unfit = "virtual time";
  EXPECT_THAT(page_of(run),
              AllOf(HasSubstr("Timing is not judged: virtual time."), Not(HasSubstr("Latency of"))));
}

TEST(Page, FilesThatAreNoReportsAreRefusedInOneLine) {
  const std::string path = test::own_folder() + "/canhil_no_report.json";
  EXPECT_THAT(read_document("/no/such").error().message, HasSubstr("/no/such: cannot be read"));
  std::ofstream(path) << "{";
  EXPECT_THAT(read_document(path).error().message, HasSubstr("is not JSON"));
  std::ofstream(path) << "[1]";
  EXPECT_THAT(read_document(path).error().message,
              HasSubstr("is not a report, expected one with \"schema\""));
  const auto torn = html(Json{{"schema", schema}, {"verdict", 5}});
  ASSERT_FALSE(torn);
  EXPECT_THAT(torn.error().message, Not(HasSubstr("\n")));
}

TEST(Page, ASeriesShorterThanItsTimesIsRefused) {
  const Json whole = Json::parse(json(scenario_of(), run_of()));
  for (const char* key : {"t_s", "low", "high", "sigma", "truth"}) {
    Json torn = whole;
    const auto has_it =
        std::ranges::find_if(torn["series"], [&](const Json& series) { return series.contains(key); });
    ASSERT_NE(has_it, torn["series"].end()) << key;
    (*has_it)[key].erase((*has_it)[key].size() - 1);
    const auto page = html(torn);
    ASSERT_FALSE(page) << key;
    EXPECT_THAT(page.error().message, HasSubstr("as many as t_s"));
  }
}

TEST(Page, ValuesTooDeepWithinOneAnotherAreRefused) {
  const std::string path = test::own_folder() + "/canhil_deep_report.json";
  std::string text = json(scenario_of(), run_of());
  const std::size_t at = text.find("\"timing\": {") + 11;
  std::string deep, end;
  for (int i = 0; i < 100'000; ++i) {
    deep += "{\"a\":";
    end += "}";
  }
  text.insert(at, "\"deep\": " + deep + "1" + end + ",");
  std::ofstream(path) << text;
  const auto read = read_document(path);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("values lie 33 deep within one another"));
}

TEST(JsonReport, CarriesDistributionsWithTheirBuckets) {
  const Json page = document(scenario_of(), run_of());
  const Json& latency = page["latency_s"]["AlignVelocityD"];
  EXPECT_EQ(latency["count"], 200);
  EXPECT_NEAR(latency["p50"].get<double>(), 300e-6, 1e-6);
  EXPECT_NEAR(latency["p999"].get<double>(), 400e-6, 1e-6);
  EXPECT_TRUE(latency["closes_group"]);
  std::uint64_t sum = 0;
  for (const Json& bucket : latency["buckets_us"]) sum += bucket[1].get<std::uint64_t>();
  EXPECT_EQ(sum, 200U);
  EXPECT_EQ(page["jitter_s"]["AlignVelocityD"]["max"], 5e-6);
  EXPECT_EQ(page["transmit_lateness_s"]["Sync"]["handed_over"]["count"], 200);
}

TEST(JsonReport, ErrorsCarryTheSigmaThatTheTargetReported) {
  const Json page = document(scenario_of(), run_of());
  const auto found = std::ranges::find_if(
      page["series"], [](const Json& s) { return s["quantity"] == "attitude error about north"; });
  ASSERT_NE(found, page["series"].end());
  const Json& north = *found;
  EXPECT_TRUE(north["sigma"].front().is_null()) << "before the first update it reported none";
  EXPECT_NEAR(north["sigma"].back().get<double>(), 2, 1e-6);
  EXPECT_NEAR(std::abs(north["high"].back().get<double>()), 1, 1e-3);
}

TEST(RoundValues, AreRoundAndFew) {
  EXPECT_THAT(round_values(0, 10, 5), Pointwise(DoubleNear(1e-9), {0.0, 2.0, 4.0, 6.0, 8.0, 10.0}));
  EXPECT_THAT(round_values(-0.03, 0.04, 5), Pointwise(DoubleNear(1e-9), {-0.02, 0.0, 0.02, 0.04}));
}

TEST(Plot, AValueThatIsNotThereIsAGap) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::string picture = drawn(LinePlot{
      .title = "x", .unit = "m", .t_s = {0, 1, 2, 3}, .low = {1, none, 2, 3}, .high = {1, none, 2, 3}});
  EXPECT_THAT(picture, Not(HasSubstr("nan")));
  EXPECT_THAT(picture, HasSubstr("d=\"M0 1L0 1ZM2 2L3 3L3 3L2 2Z\""));
}

TEST(Plot, MarksOfAnAxisCanBeDistinguished) {
  EXPECT_THAT(mark_labels({-89.9905, -89.99, -89.9895}), ElementsAre("-89.9905", "-89.9900", "-89.9895"));
  EXPECT_THAT(mark_labels({0, 0.5, 1}), ElementsAre("0", "0.5", "1.0"));
  EXPECT_THAT(mark_labels({0, 20, 40}), ElementsAre("0", "20", "40"));
  EXPECT_THAT(mark_labels({2e6, 2.1e6}), ElementsAre("2.0e+06", "2.1e+06"));
  EXPECT_THAT(mark_labels({0}), ElementsAre("0"));
}

TEST(Plot, ABarThatWouldHideTheCurveIsLeftOut) {
  LinePlot plot{.title = "x", .unit = "m", .t_s = {0, 1}, .low = {1, 1}, .high = {1, 1}};
  plot.bars = {{.below = 2, .from_s = 0, .to_s = 1, .name = "its limit"}};
  EXPECT_THAT(drawn(plot), HasSubstr("its limit"));
  plot.bars[0].below = 200;
  EXPECT_THAT(drawn(plot), Not(HasSubstr("its limit")));
}

// A browser computes places with seven digits, so the values are written less a base.
TEST(Plot, SmallChangesOfALargeValueAreCurvesOfTheirDifferences) {
  const LinePlot plot{.title = "x",
                      .unit = "m",
                      .t_s = {0, 1},
                      .low = {48123.4561, 48123.4563},
                      .high = {48123.4561, 48123.4563}};
  EXPECT_THAT(drawn(plot), AllOf(HasSubstr("data-base=\"48123\""), HasSubstr("d=\"M0 0.4561L1 0.4563L")));
}

TEST(Plot, NamedCurvesAreInTheLegend) {
  const LinePlot plot{.title = "RMS over the noise",
                      .unit = "mrad",
                      .t_s = {1, 2, 3},
                      .low = {},
                      .high = {},
                      .lines = {{.name = "kalman", .values = {1, 2, 4}}, {.name = "h2", .values = {3, 2, 1}}},
                      .t_unit = "times the noise"};
  EXPECT_THAT(drawn(plot), AllOf(HasSubstr("d=\"M1 1L2 2L3 4\""), HasSubstr("d=\"M1 3L2 2L3 1\""),
                                 HasSubstr("</svg> kalman</span>"), HasSubstr("</svg> h2</span>"),
                                 HasSubstr(">times the noise</text>")));
}

TEST(Markup, LongWordsMayBreakAndTagsAndEntitiesStayWhole) {
  EXPECT_EQ(breakable("short words"), "short words");
  EXPECT_EQ(breakable("transfer_alignment.toml"), "transfer_<wbr>alignment.<wbr>toml");
  EXPECT_EQ(breakable("AlignVelocityD"), "AlignVelocity<wbr>D");
  EXPECT_EQ(breakable("0123456789abcdef0"), "0123456789abcdef<wbr>0");
  EXPECT_EQ(breakable("<a href=\"#a_long_anchor\">0123456789abc&amp;&lt;&gt;x</a>"),
            "<a href=\"#a_long_anchor\">0123456789abc&amp;&lt;&gt;<wbr>x</a>");
  EXPECT_EQ(breakable("0.125", 2), "0.<wbr>125");
}

TEST(Plot, ARingIsAroundTheLargestValueOfItsTime) {
  LinePlot plot{.title = "x", .unit = "m", .t_s = {0, 1, 2}, .low = {0, -8, 0}, .high = {4, 4, 4}};
  const auto ring_at = [&](double t_s) {
    plot.worst = {{.t_s = t_s}};
    const std::string picture = drawn(plot);
    const std::size_t at = picture.find("<circle");
    return at == std::string::npos ? std::string("none") : picture.substr(at, picture.find("/>", at) - at);
  };
  const std::string low = ring_at(1.0);
  EXPECT_EQ(low, ring_at(1.9)) << "of the point at or before it";
  EXPECT_NE(low, ring_at(2.0));
  EXPECT_EQ(ring_at(2.1), "none");
  // The axis shows -8.6 to 4.6 from bottom to top, so -8 is far below 4.
  const auto height = [](const std::string& ring) { return std::stod(ring.substr(ring.find("cy=\"") + 4)); };
  EXPECT_GT(height(low), height(ring_at(0.0)) + 50);
}

TEST(Page, ACheckIsALinkToItsPictureWhichMarksTheWorst) {
  Json report = document(scenario_of(), run_of());
  Json& series = report["series"][1];
  series["bars"] = {{{"check", "its limit"}, {"statistic", "max"}, {"below", 1}, {"from_s", 0}, {"to_s", 1}}};
  Json check = report["checks"][0];
  check["name"] = "its limit";
  check["worst_at_s"] = series["t_s"][0];
  report["checks"].push_back(check);
  const std::string page = html(report).value();
  EXPECT_THAT(page, AllOf(HasSubstr("<a href=\"#series-1\">its limit</a>"),
                          HasSubstr("<article class=\"figure\" id=\"series-1\">"),
                          HasSubstr("the largest that 'its limit' judged")));
}

}  // namespace
}  // namespace canhil::report
