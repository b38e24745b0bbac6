#include "bench/estimators/end_of_flight.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::estimators {

std::optional<Passage> Passage::find(const world::PlantRecords& plants) {
  const auto relative =
      world::PlantColumns<3>::find(plants, {"plant.relative.x", "plant.relative.y", "plant.relative.z"});
  if (!relative) return std::nullopt;
  const world::PlantRecord& record = relative->record();
  Passage passage{.late_commands = record.late};
  if (record.ended_us) {
    const auto miss = relative->of_row(record.times_us().size() - 1);
    passage.miss_n = world::Vector3(miss.data());
    passage.t_us = *record.ended_us;
  }
  return passage;
}

ResultLine end_of_flight(const Passage& passage) {
  ResultLine end{.name = "end", .what = "end of the flight"};
  if (passage.miss_n) {
    const double miss = passage.miss_n->norm(), passage_s = static_cast<double>(passage.t_us) * 1e-6;
    end.add("miss", miss, fmt::format("miss {:.3f} m", miss));
    end.add("passage", passage_s, fmt::format("at {:.3f} s", passage_s));
  } else {
    end.add("miss", std::nullopt, "the target was not passed");
  }
  if (passage.late_commands > 0) {
    end.add("late_commands", static_cast<double>(passage.late_commands),
            fmt::format("{} answers too late to guide", passage.late_commands));
  }
  return end;
}

std::int64_t answers_end_us(const world::PlantRecords& plants, std::int64_t duration_us) {
  const auto passage = Passage::find(plants);
  return passage && passage->miss_n ? std::min(duration_us, passage->t_us) : duration_us;
}

}  // namespace canhil::estimators
