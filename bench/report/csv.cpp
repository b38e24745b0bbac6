#include "bench/report/run_reports.hpp"

#include <fmt/format.h>

#include "bench/report/flags.hpp"
#include "bench/report/series.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::report {
namespace {

std::string field(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

}  // namespace

void csv(const scenario::Scenario& scenario, const drive::Run& run, const Sink& give) {
  using quantities::Track;
  give("t_s,estimator,quantity,unit,estimate,truth,error,sigma\n");
  give_tracks(scenario, run, [&](std::string_view estimator, const Track& track) {
    const std::string of = fmt::format("{},{},{}", for_csv(estimator), for_csv(track.quantity->name),
                                       for_csv(quantities::si_name(track.unit)));
    const bool is_error = track.kind == Track::Kind::error;
    for (const quantities::TrackPoint& point : track.points) {
      const auto estimate = is_error ? point.estimate : std::optional(point.value);
      const auto error = is_error && run.truth.is_known() ? std::optional(point.value) : std::nullopt;
      give(fmt::format("{:.6f},{},{},{},{},{}\n", static_cast<double>(point.t_us) * 1e-6, of, field(estimate),
                       field(point.truth), field(error), field(point.sigma)));
    }
  });
  for (const auto& [facts, record] : plants_of(scenario, run)) {
    for (std::size_t column = 0; column < facts.outputs.size(); ++column) {
      const scenario::PlantFacts::Output& output = facts.outputs[column];
      for (std::size_t i = 0; i < record.times_us().size(); ++i)
        give(fmt::format("{:.6f},plant,{},{},,{},,\n", static_cast<double>(record.times_us()[i]) * 1e-6,
                         for_csv(output.name), for_csv(output.si), record.value(column, i)));
    }
  }
  give_flags(scenario, run, [&](std::string_view estimator, std::string_view flag, const auto& changes) {
    for (const auto& [t_us, is_set] : changes)
      give(fmt::format("{:.6f},{},{},flag,{},,,\n", static_cast<double>(t_us) * 1e-6, for_csv(estimator),
                       for_csv(flag), is_set ? 1 : 0));
  });
}

}  // namespace canhil::report
