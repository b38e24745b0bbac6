#include "bench/checks/sighting.hpp"

#include <fmt/format.h>

#include "dbc/wire/e2e.hpp"

namespace canhil::checks {

std::string faults_of(const Sighting& sighting, const MessageInfo& message) {
  std::string text;
  const auto add = [&](std::uint64_t count, const std::string& what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add(sighting.wrong_crc, "with a wrong CRC");
  add(sighting.wrong_counter, fmt::format("with counter {}, which is not allowed, expected 0 to {}",
                                          sighting.counter, e2e::counter_period - 1));
  add(sighting.wrong_size, fmt::format("of {} bytes, expected {}", sighting.size, message.size));
  return text;
}

}  // namespace canhil::checks
