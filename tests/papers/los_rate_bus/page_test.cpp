#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "tests/papers/reproduced.hpp"

namespace canhil::papers {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// The page has two drawings of each figure, a wide and a narrow one. Expects that the name of a curve does
// not extend beyond the edge of either drawing. The width of a character is assumed to be 0.63 of the font
// size, as in a wide sans-serif font.
void expect_names_within(const std::string& html, const std::string& name) {
  const std::regex drawing("viewBox=\"0 0 ([0-9]+) [0-9]+\"");
  const std::regex label(
      "translate\\(([0-9.]+),[0-9.]+\\)\"[^>]*font-size=\"([0-9.]+)\"[^>]*>\\s*<text><tspan[^>]*>" + name +
      "<");
  int found = 0;
  for (std::size_t at = html.find("<svg"); at != std::string::npos; at = html.find("<svg", at + 1)) {
    const std::string svg = html.substr(at, html.find("</svg>", at) - at);
    std::smatch width, place;
    ASSERT_TRUE(std::regex_search(svg, width, drawing));
    if (!std::regex_search(svg, place, label)) continue;
    const double end = std::stod(place[1]) + 0.63 * std::stod(place[2]) * static_cast<double>(name.size());
    EXPECT_LE(end, std::stod(width[1])) << name;
    ++found;
  }
  EXPECT_EQ(found, 2) << "wide and narrow";
}

TEST(LosPage, HasEveryFigureTableAndVerdictInOneFile) {
  const auto [html, text] = reproduced("los", "los_page");
  for (const char* figure : {"fig2", "fig3"})
    EXPECT_THAT(html, HasSubstr(std::string("<article class=\"figure\" id=\"") + figure + "\">"));
  for (const char* section :
       {"open-loop", "closing-speed", "formulas", "closed-loop", "delays", "glint", "settings"})
    EXPECT_THAT(html, HasSubstr(std::string("id=\"") + section + "\""));
  EXPECT_THAT(html, Not(HasSubstr("src=")));  // the page needs no other file
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  const std::string fig2 = html.substr(html.find("<article class=\"figure\" id=\"fig2\">"));
  EXPECT_THAT(fig2.substr(0, fig2.find("</article>")), HasSubstr("12 rad/s")) << "the best by miss";
  EXPECT_THAT(fig2.substr(0, fig2.find("</article>")), HasSubstr("Error bars: 95 % range of the RMS"));
  expect_names_within(fig2.substr(0, fig2.find("</article>")), "combined");
  EXPECT_THAT(text, ContainsRegex("one gain for all noises: the same +our extension +RMS"))
      << "the paper does not claim it";
  EXPECT_THAT(text, HasSubstr("bar: combined over Kalman filter, 3-2 s"));
  EXPECT_THAT(text, HasSubstr("bar: miss: combined over low-pass of 8 rad/s"));
  EXPECT_THAT(text, HasSubstr("The limits are for 200 runs"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace canhil::papers
