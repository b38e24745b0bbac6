// A request of the bench and the target's answer to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace canhil::checks {

struct Exchange {
  std::size_t event = 0;  ///< index in Scenario::events
  std::vector<std::uint8_t> request{};
  std::int64_t sent_ns = 0;  ///< when its last frame was on the bus, by the stamp clock
  std::optional<std::vector<std::uint8_t>> answer{};
  std::int64_t answered_ns = 0;  ///< when the last frame of the answer was on the bus
  std::string broken{};          ///< why an answer that began is lost; empty: none is
};

}  // namespace canhil::checks
