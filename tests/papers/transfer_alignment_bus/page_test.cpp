// The complete reproduction of the paper with two runs per variant: reads and runs every campaign, draws
// every figure.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "bench/papers/gnuplot.hpp"
#include "bench/papers/paper.hpp"
#include "tests/papers/reproduced.hpp"

namespace canhil::papers {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(PaperPage, HasEveryFigureTableAndVerdictInOneFile) {
  const auto [html, text] = reproduced("transfer", "paper_page");
  for (const char* figure : {"fig3", "fig4", "fig5", "fig6-kf", "fig6-h2", "fig7-heading", "fig7-roll",
                             "fig7-pitch", "velocity", "artefact", "noise"})
    EXPECT_THAT(html, HasSubstr(std::string("<article class=\"figure\" id=\"") + figure + "\">"));
  for (const char* bar : {"bar 4", "bar 5", "bar 6", "bar 7", "bar 8", "bar 9"})
    EXPECT_THAT(html, HasSubstr(bar));
  EXPECT_THAT(html, HasSubstr(">paper H2<")) << "what is known of the paper's own curve";
  EXPECT_THAT(html, HasSubstr("2 runs per curve, seed 20010101, frames quantised as on the bus"));
  EXPECT_THAT(html, HasSubstr("each through the codec with frames quantised as on the bus."));
  EXPECT_THAT(html, Not(HasSubstr("rounding (--unrounded)")));
  EXPECT_THAT(html, Not(HasSubstr("src=")));  // the page needs no other file
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  EXPECT_THAT(text, HasSubstr("The limits are for 300 runs: with fewer they may fail by chance."));
  // The first paragraph must agree with the verdicts below it. With only two runs, the paper's claims about
  // the Kalman filter and about H2 case 2 have the verdict 'does not reproduce'.
  EXPECT_THAT(html,
              HasSubstr("errors are 5 deg. Table 2, Kalman filter: does not reproduce; its heading enters"));
  EXPECT_THAT(html, HasSubstr("Table 2, H2 case 2 is faster: does not reproduce; its heading enters"));
  EXPECT_THAT(text, HasSubstr("Table 2"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(PaperPage, BarsThatTooFewRunsMissSayNothing) {
  EXPECT_EQ(outcome_of(false, 49, 50), Outcome::too_few_runs);
  EXPECT_EQ(outcome_of(false, 50, 50), Outcome::bars_missed);
  EXPECT_EQ(outcome_of(true, 49, 50), Outcome::bars_met);
}

TEST(PaperPage, NamesWhatIsWrongWithTheRequest) {
  Request unknown = request("transfer", "paper_errors");
  unknown.paper = "transfr";
  EXPECT_EQ(complaint(unknown), "paper 'transfr' is unknown, expected transfer or inflight or los or wind");
  Request no_folder = request("transfer", "paper_errors");
  no_folder.folder = "/dev/null/page";
  EXPECT_EQ(complaint(no_folder), "folder '/dev/null/page': cannot be made: Not a directory");
  Request no_exact = request("transfer", "paper_errors");
  no_exact.exact = "/nowhere.sqlite";
  EXPECT_THAT(complaint(no_exact), HasSubstr("/nowhere.sqlite"));
}

TEST(PaperPage, SaysThatGnuplotIsMissing) {
  const char* found = std::getenv("PATH");
  ASSERT_NE(found, nullptr);
  const std::string path = found;
  setenv("PATH", "/nowhere", 1);
  const auto there = check_gnuplot();
  setenv("PATH", path.c_str(), 1);
  ASSERT_FALSE(there);
  EXPECT_EQ(there.error().message,
            "gnuplot: cannot be started (No such file or directory), expected Debian's package gnuplot-nox");
}

TEST(PaperPage, ReportsWhatGnuplotSaysOfABadScript) {
  const auto drawn = gnuplot("plot nonsense(\n");
  ASSERT_FALSE(drawn);
  EXPECT_THAT(drawn.error().message, HasSubstr("gnuplot: ended with status"));
}

}  // namespace
}  // namespace canhil::papers
