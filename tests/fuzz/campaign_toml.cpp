// Tests the code that reads a campaign file. For any text, it must return a Campaign, or one error line that
// names the file. The text may also contain settings by which variants and sweeps change a scenario; the
// scenario itself is always the short scenario.
#include <cstdint>

#include "bench/campaign/campaign.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/fuzz/short_scenario.hpp"

using namespace canhil;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto campaign = campaign::parse_campaign(
      text, "fuzz.toml",
      [](const std::string&) -> Result<std::string> { return std::string(fuzz::short_scenario); });
  if (!campaign) {
    fuzz::expect_one_line(campaign.error().message, "fuzz.toml:");
    return 0;
  }
  // The store of a campaign contains the texts of the campaign's files. These texts must give the same
  // campaign.
  const auto again = campaign::parse_campaign(campaign->sources);
  fuzz::expect(again && again->hash == campaign->hash && again->variants.size() == campaign->variants.size());
  for (const campaign::Metric& metric : campaign->metrics) {
    for (const std::size_t variant : campaign::variants_of(*campaign, metric))
      fuzz::expect(variant < campaign->variants.size());
  }
  return 0;
}
