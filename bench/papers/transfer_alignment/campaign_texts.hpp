// The files of bench/campaigns/paper_transfer, built into the program: the reproduction needs no source tree.
#pragma once

#include <array>
#include <string_view>

namespace canhil::papers::transfer_alignment {

struct CampaignText {
  std::string_view name;  ///< of the file, without its ending
  std::string_view text;
};

inline constexpr std::size_t campaign_count = 8;
extern const std::array<CampaignText, campaign_count> campaign_texts;
extern const std::string_view flight_text;  ///< flight.toml, the scenario of all of them

}  // namespace canhil::papers::transfer_alignment
