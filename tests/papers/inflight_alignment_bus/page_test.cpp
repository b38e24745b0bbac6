#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/papers/reproduced.hpp"

namespace canhil::papers {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(InflightPage, HasEveryFigureTableAndVerdictInOneFile) {
  const auto [html, text] = reproduced("inflight", "inflight_page");
  for (const char* figure : {"fig5", "fig6", "fig7", "fig8", "fig9", "fig10"})
    EXPECT_THAT(html, HasSubstr(std::string("<article class=\"figure\" id=\"") + figure + "\">"));
  for (const char* bar : {"bar B", "bar C", "bar D"}) EXPECT_THAT(html, HasSubstr(bar));
  for (const char* section : {"starts", "paths", "forms", "late", "losses", "settings"})
    EXPECT_THAT(html, HasSubstr(std::string("id=\"") + section + "\""));
  EXPECT_THAT(html, Not(HasSubstr("src=")));  // the page needs no other file
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  EXPECT_THAT(text, HasSubstr("The limits are for 400 runs"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(InflightPage, TakesNoResultsOfTheTwin) {
  Request asked = request("inflight", "inflight_errors");
  asked.exact = "/nowhere.sqlite";
  EXPECT_THAT(complaint(asked), HasSubstr("--exact: paper 'inflight' compares with no results"));
}

}  // namespace
}  // namespace canhil::papers
