// Tests the acceptance limits ('bars') B and C for the paper on in-flight alignment, with 40 runs over the
// bus. bars.toml explains how the limits are derived.
#include "tests/papers/bars.hpp"

#include <algorithm>

namespace canhil::papers {
namespace {

TEST(InflightAlignmentPaperOverTheBus, MeetsTheBarsWith40Runs) {
  const auto answers = expect_bars_met("tests/papers/inflight_alignment_bus/bars.toml", 8);
  const auto rms_deg = [&](const char* variant) {
    const auto found = std::ranges::find_if(answers, [&](const campaign::Answer& answer) {
      return answer.variant == variant && answer.quantity == &quantities::attitude_heading;
    });
    if (found == answers.end()) {
      ADD_FAILURE() << variant;
      return 0.0;
    }
    EXPECT_EQ(found->figures.front().first, "rms_deg");
    return found->figures.front().second.value_or(0);
  };
  // Bar C: with 400 runs, the two RMS may differ by 20 %; here the limit is 30 %. Both variants have the same
  // random numbers in each run, so the ratio of the two RMS hardly depends on the number of runs.
  EXPECT_NEAR(rms_deg("gps_sincos_180") / rms_deg("gps_sincos_30"), 1, 0.3);
  EXPECT_NEAR(rms_deg("ssbl_sincos_180") / rms_deg("ssbl_sincos_30"), 1, 0.3);
}

}  // namespace
}  // namespace canhil::papers
