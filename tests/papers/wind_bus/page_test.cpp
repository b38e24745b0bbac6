#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/papers/reproduced.hpp"

namespace canhil::papers {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(WindPage, HasEveryTableAndVerdictInOneFile) {
  const auto [html, text] = reproduced("wind", "wind_page");
  for (const char* section : {"claims", "table1", "glide", "models", "sensitivity", "timing", "settings"})
    EXPECT_THAT(html, HasSubstr(std::string("id=\"") + section + "\""));
  for (const char* figure : {"fig5", "fig6"})
    EXPECT_THAT(html, HasSubstr(std::string("<article class=\"figure\" id=\"") + figure + "\">"));
  EXPECT_THAT(html, Not(HasSubstr("src=")));  // the page needs no other file
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  EXPECT_THAT(text, HasSubstr("The limits are for 50 runs"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace canhil::papers
