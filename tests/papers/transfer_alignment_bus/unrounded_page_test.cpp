// If a reproduction is flown with unrounded frames, its page must state this.
#include <gmock/gmock.h>

#include "tests/papers/reproduced.hpp"

namespace canhil::papers {
namespace {

using testing::HasSubstr;
using testing::Not;

Request unrounded(const char* folder) {
  Request request = papers::request("transfer", folder);
  request.rounding = Rounding::none;
  return request;
}

TEST(UnroundedPaperPage, ClaimsNoQuantisation) {
  const auto [html, text] = reproduced(unrounded("paper_page_unrounded"));
  EXPECT_THAT(html, Not(HasSubstr("quantised")));
  EXPECT_THAT(html,
              HasSubstr("2 runs per curve, seed 20010101, frames without the bus's rounding (--unrounded)"));
  EXPECT_THAT(html, HasSubstr("flown over the bus without its rounding: 2 runs"));
  EXPECT_THAT(html, HasSubstr("The results on this page are without the bus's rounding"));
}

TEST(UnroundedPaperPage, HasNothingToCompareWithItself) {
  Request compared = unrounded("paper_errors_unrounded");
  compared.exact = "exact.sqlite";
  EXPECT_THAT(complaint(compared), HasSubstr("--exact: with --unrounded nothing rounds"));
}

}  // namespace
}  // namespace canhil::papers
