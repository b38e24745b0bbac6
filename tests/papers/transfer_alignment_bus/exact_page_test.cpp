// The page of the twin that rounds nothing says so.
#include <gmock/gmock.h>

#include "tests/papers/reproduced.hpp"

namespace canhil::papers {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ExactPaperPage, ClaimsNoQuantisation) {
  const auto [html, text] = reproduced("transfer", "paper_page_exact");
  EXPECT_THAT(html, Not(HasSubstr("quantised")));
  EXPECT_THAT(
      html, HasSubstr("2 runs a curve, seed 20010101, frames without the bus's rounding (hil-bench-exact)"));
  EXPECT_THAT(html, HasSubstr("flown over the bus without its rounding: 2 runs"));
  EXPECT_THAT(html, HasSubstr("Nothing on this page has the bus's rounding"));
}

TEST(ExactPaperPage, HasNothingToCompareWithItself) {
  Request compared = request("transfer", "paper_errors_exact");
  compared.exact = "exact.sqlite";
  EXPECT_THAT(complaint(compared), HasSubstr("--exact: this program rounds nothing itself"));
}

}  // namespace
}  // namespace canhil::papers
