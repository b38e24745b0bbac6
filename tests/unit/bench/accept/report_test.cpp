// Tests the verdicts of requirements, and the reports as text, JSON, JUnit and HTML.
#include "bench/accept/report.hpp"

#include <gmock/gmock.h>

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
          "FAIL          B            It <is>.  (2 looked at)\n      - flight 'a': 5 & more; expected 4"));
  EXPECT_THAT(text(all), HasSubstr("wind: fail: 1 of 2 requirements met, 1 not met"));
  EXPECT_THAT(json(all), HasSubstr("\"schema\": \"canhil-acceptance-1\""));
  EXPECT_THAT(junit(all), HasSubstr("<failure message=\"5 &amp; more; expected 4\"/>"));
  EXPECT_THAT(page(all), HasSubstr("It &lt;is&gt;."));
  EXPECT_THAT(page(all), HasSubstr("5 &amp; more"));
  EXPECT_THAT(page(all), Not(HasSubstr("<is>")));
}

}  // namespace
}  // namespace canhil::accept
