#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/papers/reproduced.hpp"

namespace canhil::papers {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(LosPage, HasEveryFigureTableAndVerdictInOneFile) {
  const auto [html, text] = reproduced("los", "los_page");
  for (const char* figure : {"fig2", "fig3"})
    EXPECT_THAT(html, HasSubstr(std::string("<figure id=\"") + figure + "\">"));
  for (const char* section :
       {"open-loop", "closing-speed", "formulas", "closed-loop", "delays", "glint", "settings"})
    EXPECT_THAT(html, HasSubstr(std::string("id=\"") + section + "\""));
  EXPECT_THAT(html, Not(HasSubstr("src=")));  // nothing from outside
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  EXPECT_THAT(text, HasSubstr("bar: combined over Kalman filter, 3-2 s"));
  EXPECT_THAT(text, HasSubstr("bar: miss: combined over low-pass of 8 rad/s"));
  EXPECT_THAT(text, HasSubstr("The bars are for 200 runs"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace canhil::papers
