// The campaign whose runs are measured: Table 2 of the transfer-alignment paper, flights of 20 s with an IMU
// of 100 Hz.
#pragma once

#include <cstdio>
#include <cstdlib>

#include "bench/campaign/campaign.hpp"

namespace canhil {

/// Ends the program if the campaign cannot be read.
inline campaign::Campaign paper_campaign() {
  auto read = campaign::read_campaign(SOURCE_DIR "/bench/monte_carlo/paper_transfer/table2.toml");
  if (read) return std::move(*read);
  std::fprintf(stderr, "%s\n", read.error().message.c_str());
  std::exit(1);
}

}  // namespace canhil
