#include "bench/drive/ending.hpp"

#include <fmt/format.h>

namespace canhil::drive {

Ending gone_at(std::int64_t t_us, const std::string& why) {
  return {Ending::Kind::target_ended, t_us,
          fmt::format("{} at t={:.3f} s", why, static_cast<double>(t_us) * 1e-6)};
}

}  // namespace canhil::drive
