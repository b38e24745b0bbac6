#include "bench/scenario/rule.hpp"

#include <fmt/format.h>

namespace canhil::scenario {
namespace {

double seconds(std::int64_t t_us) { return static_cast<double>(t_us) / 1e6; }

}  // namespace

void expect_within_run(Section& section, std::string_view key, std::int64_t t_us, std::int64_t duration_us) {
  if (t_us <= duration_us) return;
  section.reject(key, "is after the end of the run",
                 fmt::format("at most duration_s = {}", seconds(duration_us)));
}

std::int64_t read_time(Section& section, const Key& key, Limits limits, std::int64_t duration_us) {
  const std::int64_t t_us = section.time_us(key, limits);
  expect_within_run(section, key.name, t_us, duration_us);
  return t_us;
}

Window read_window(Section& section, std::int64_t duration_us) {
  const Window window{
      .from_us = section.time_us({"from_s",
                                  "Start of the window. An answer belongs to the window if the time of "
                                  "validity of its cause lies in the window."},
                                 Limits::at_least(0), 0),
      .to_us = section
                   .optional_time_us({"to_s", "End of the window; by default the end of the run."},
                                     Limits::at_least(0))
                   .value_or(duration_us)};
  expect_within_run(section, "to_s", window.to_us, duration_us);
  if (window.from_us >= window.to_us) {
    section.reject("from_s", "is not before the end of the window",
                   fmt::format("less than {}", seconds(window.to_us)));
  }
  return window;
}

}  // namespace canhil::scenario
