// The sections of a run's page, each as HTML from the report's JSON.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "bench/report/page_parts.hpp"

namespace canhil::report {

/// A time of a distribution in ms.
inline std::string ms(const Json& distribution, const char* key) {
  return fmt::format("{:.3f}", distribution.at(key).get<double>() * 1e3);
}
/// A time in ms, which may be null.
inline std::string ms_or_none(const Json& seconds) {
  return seconds.is_null() ? "not known" : fmt::format("{:.3f}", seconds.get<double>() * 1e3);
}

// The pictures.

/// A distribution of times.
std::string histogram(const std::string& title, const Json& distribution);

/// The largest time in each stretch of the run.
std::string course(const std::string& title, const Json& line);

/// A drawing of the largest value in each stretch of the run, on an axis that begins at zero. `scale`
/// converts the numbers to the unit.
std::string from_zero(const std::string& title, const std::string& unit, double stretch_s,
                      const Json& largest, double scale);

/// A quantity over the run. If the scale of this picture hides the later course or the limits of checks, a
/// second picture shows that part of the run.
std::string estimate(const Json& series, const Json& report, std::string_view id);
/// The id of the plot of a series, by its number in the report.
std::string series_id(std::size_t number);

/// When the flags of an estimator were set; flags that never were are left out.
std::string flags(const Json& all, const std::string& estimator, double end_s);

// The sections.

/// What differs from the scenario's files and from an undisturbed run: faults, set values, notes; empty:
/// nothing.
std::string changes_section(const Json& report);
std::string checks_section(const Json& report);
/// The results of the run for each estimator.
std::string results_section(const Json& report);
/// The estimates and the truth over time.
std::string estimates_section(const Json& report);
/// Latency, jitter and lateness, and missing answers. In virtual time, the section gives only the reason why
/// there are no times.
std::string timing_section(const Json& report);
/// Load, drops and errors.
std::string bus_section(const Json& report);
std::string provenance_section(const Json& report);

}  // namespace canhil::report
