#include "bench/estimators/end_of_flight.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::estimators {

ResultLine end_of_flight(const world::EngagementRecord& engagement) {
  ResultLine end{.name = "end", .what = "end of the flight"};
  if (engagement.miss_n) {
    const double miss = engagement.miss_n->norm(),
                 passage_s = static_cast<double>(engagement.passage_us) * 1e-6;
    end.add("miss", miss, fmt::format("miss {:.3f} m", miss));
    end.add("passage", passage_s, fmt::format("at {:.3f} s", passage_s));
  } else {
    end.add("miss", std::nullopt, "the target was not passed");
  }
  if (engagement.late_commands > 0) {
    end.add("late_commands", static_cast<double>(engagement.late_commands),
            fmt::format("{} answers too late to guide", engagement.late_commands));
  }
  return end;
}

std::int64_t answers_end_us(const world::EngagementRecord& engagement, std::int64_t duration_us) {
  return engagement.miss_n ? std::min(duration_us, engagement.passage_us) : duration_us;
}

}  // namespace canhil::estimators
