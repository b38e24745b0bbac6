// Tests the verdicts of requirements, and the reports as text, JSON, JUnit and HTML.
#include "bench/accept/report.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace canhil::accept {
namespace {

using checks::Outcome;
using testing::HasSubstr;
using testing::Not;

Finding finding(const std::string& id, const std::vector<Outcome>& outcomes) {
  Finding one{.requirement = {.id = id, .family = "errors", .text = "It <is>."}, .items = {}};
  for (const Outcome outcome : outcomes)
    one.items.push_back({.name = "flight 'a'",
                         .kind = "error",
                         .requirement = id,
                         .outcome = outcome,
                         .measured = "5 & more",
                         .expected = "4"});
  return one;
}

Report report(std::vector<Finding> findings) {
  return {.target = "./target",
          .started_s = 0,
          .suites = {{.estimator = "wind", .title = "Wind", .findings = std::move(findings), .wall_s = 2}}};
}

TEST(Verdict, FailsWhereOneThingFailsAndIsNotMeasuredWhereNothingWasLookedAt) {
  EXPECT_EQ(finding("A", {Outcome::pass, Outcome::pass}).outcome(), Outcome::pass);
  EXPECT_EQ(finding("A", {Outcome::pass, Outcome::fail, Outcome::not_measured}).outcome(), Outcome::fail);
  EXPECT_EQ(finding("A", {Outcome::pass, Outcome::not_measured}).outcome(), Outcome::not_measured);
  EXPECT_EQ(finding("A", {}).outcome(), Outcome::not_measured);
  EXPECT_EQ(report({finding("A", {Outcome::pass}), finding("B", {Outcome::fail})}).outcome(), Outcome::fail);
  EXPECT_EQ(report({finding("A", {Outcome::pass}), finding("B", {})}).outcome(), Outcome::not_measured);
  EXPECT_EQ(report({finding("A", {Outcome::pass})}).outcome(), Outcome::pass);
  EXPECT_EQ(Report{}.outcome(), Outcome::not_measured);
}

TEST(Reports, NameWhatIsWrongInEveryForm) {
  const Report all = report({finding("A", {Outcome::pass}), finding("B", {Outcome::fail, Outcome::pass})});
  EXPECT_THAT(
      text(all),
      HasSubstr(
          "FAIL          B              It <is>.  (2 tests)\n      - flight 'a': 5 & more; expected 4"));
  EXPECT_THAT(text(all), HasSubstr("wind: fail: 1 of 2 requirements met, 1 not met"));
  EXPECT_THAT(json(all), HasSubstr("\"schema\": \"canhil-acceptance-1\""));
  EXPECT_THAT(junit(all), HasSubstr("<failure message=\"5 &amp; more; expected 4\"/>"));
  EXPECT_THAT(page(all), HasSubstr("It &lt;is&gt;."));
  EXPECT_THAT(page(all), HasSubstr("5 &amp; more"));
  EXPECT_THAT(page(all), Not(HasSubstr("<is>")));
}

// A report of some families, with other tolerances, must not be taken for a whole one.
TEST(Reports, SayWhatWasAskedAboutWhichFiles) {
  Report all = report({finding("A", {Outcome::pass})});
  all.same_as = "hil-target";
  all.tolerance = 10;
  all.families = {"honesty"};
  all.seed = 17;
  all.files = {{.role = "target", .name = "/bin/target", .identity = {.sha256 = "ab12"}}};
  const auto written = nlohmann::json::parse(json(all));
  EXPECT_EQ(written["options"],
            nlohmann::json::parse(R"({"families": ["honesty"], "tolerance": 10, "seed": 17})"));
  EXPECT_EQ(written["provenance"]["files"][0]["sha256"], "ab12");
  const std::string html = page(all);
  for (const char* shown : {"honesty", "17", "multiplied by 10", "/bin/target", "ab12"})
    EXPECT_THAT(html, HasSubstr(shown));
}

// The nearest limit of a requirement is shown beside it.
TEST(Reports, ShowTheSmallestMargin) {
  Finding one = finding("A", {Outcome::pass, Outcome::pass});
  one.items[0].judgement = {.criterion = {.upper = checks::Limit{.value = 4}}, .measurement = {.value = 3}};
  one.items[1].judgement = {.criterion = {.upper = checks::Limit{.value = 4}}, .measurement = {.value = 1}};
  EXPECT_THAT(text(report({one})), HasSubstr("(2 tests, the smallest margin 25 %)"));
}

}  // namespace
}  // namespace canhil::accept
