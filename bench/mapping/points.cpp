#include "bench/mapping/points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/estimators/tracks.hpp"
#include "bench/quantities/unwrapped.hpp"

namespace canhil::mapping {
namespace {

using estimators::Truth;
using quantities::TrackPoint;
using What = ReportedSignal::What;

double difference(const ReferenceQuantity& of, double a, double b) {
  return of.turns ? std::remainder(a - b, 2 * std::numbers::pi) : a - b;
}

// Reads a series in order of time: the latest item at or before a time that never decreases.
template <class Series>
class Latest {
 public:
  Latest(const Series& series, double longest_us)
      : next_(series.begin()), end_(series.end()), longest_us_(longest_us) {}

  /// Null: there is none, or the series has been silent since.
  const typename Series::value_type* at(std::int64_t t_us) {
    for (; next_ != end_ && (*next_).t_us <= t_us; ++next_) latest_ = *next_;
    const bool there = latest_ && static_cast<double>(t_us - latest_->t_us) <= longest_us_;
    return there ? &*latest_ : nullptr;
  }

 private:
  typename Series::const_iterator next_, end_;
  std::optional<typename Series::value_type> latest_;
  double longest_us_;
};

// A signal of values, sigmas or correlations; null: the target has none. A correlation has no order.
struct Told {
  const ReportedSignal* signal = nullptr;
  const Hear* in = nullptr;
};
Told told(const MappedTarget& target, What what, const quantities::Quantity* of,
          const quantities::Quantity* other = nullptr) {
  for (const Hear& hear : target.hears) {
    for (const ReportedSignal& one : hear.reported_signals) {
      if (one.what != what) continue;
      const auto *a = one.quantity->quantity, *b = one.other == nullptr ? nullptr : one.other->quantity;
      if ((a == of && b == other) || (a == other && b == of)) return {&one, &hear};
    }
  }
  return {};
}

// A sigma that is negative or infinite says as little as one that is not a number.
std::optional<double> checked(const std::optional<double>& sigma) {
  return sigma && !(*sigma >= 0 && std::isfinite(*sigma)) ? std::nan("") : sigma;
}

// The values of a signal of sigmas or correlations over a run; none where the target says that it has none.
class Values {
 public:
  Values(const Told& told, const checks::Observations& seen) {
    const auto& all = seen.of<Answers>().values;
    const auto found = told.signal == nullptr ? all.end() : all.find(told.signal);
    if (found != all.end()) latest_.emplace(found->second, longest_wait_us(seen, *told.in));
  }
  std::optional<double> at(std::int64_t t_us) {
    const TimedValue* one = latest_ ? latest_->at(t_us) : nullptr;
    return one == nullptr || one->none ? std::nullopt : std::optional(one->value);
  }

 private:
  std::optional<Latest<Answers::Values>> latest_;
};

Points reported(const ReferenceQuantity& of, const MappedTarget& target, const checks::Observations& seen,
                const Truth& truth) {
  Points all;
  const Answers& answers = seen.of<Answers>();
  const auto values = answers.values.find(told(target, What::value, of.quantity).signal);
  if (values == answers.values.end()) return all;
  const Told sigma = told(target, What::sigma, of.quantity);
  Values sigmas(sigma, seen);
  double last_truth = 0;
  for (const TimedValue& one : values->second) {
    if (one.t_us > truth.duration_us) continue;
    if (!of.has_truth()) {
      all.points.push_back({.t_us = one.t_us, .value = std::nan(""), .estimate = one.value});
      continue;
    }
    const auto at = truth_of(of, truth, one.t_us);
    if (!at && truth.flight.is_known()) all.without_truth.push_back(one.t_us);
    if (!at) continue;
    const double error = difference(of, one.value, *at);
    // The truth is unwrapped where it passes half a turn, the estimate to within half a turn of the truth.
    last_truth = of.turns ? quantities::unwrapped(*at, last_truth) : *at;
    TrackPoint point{.t_us = one.t_us,
                     .value = error,
                     .sigma = checked(sigmas.at(one.t_us)),
                     .estimate = last_truth + error,
                     .truth = last_truth};
    if (point.sigma && sigma.signal->in_metres)
      *point.sigma /=
          of.turns ? metres_of_longitude(truth.flight, one.t_us) : metres_of_latitude(truth.flight, one.t_us);
    all.points.push_back(point);
  }
  return all;
}

Points derived(const ReferenceQuantity& of, const MappedTarget& target, const checks::Observations& seen,
               const Truth& truth) {
  Points all;
  std::vector<Spool<TrackPoint>> series;
  for (const quantities::Quantity* part : of.of)
    series.push_back(points_of(*find_reference_quantity(part->name), target, seen, truth).points);
  const std::size_t n = series.size();
  std::vector<Latest<Spool<TrackPoint>>> latest;
  std::vector<Values> correlations;  // of part i with part j at i * n + j
  for (std::size_t i = 0; i < n; ++i) {
    latest.emplace_back(series[i], longest_wait_us(seen, hear_of(target, of.of[i])));
    for (std::size_t j = 0; j < n; ++j)
      correlations.emplace_back(i == j ? Told{} : told(target, What::correlation, of.of[i], of.of[j]), seen);
  }
  std::vector<TrackPoint> parts(n);
  for (const TrackPoint& last : series.back()) {
    bool whole = true;
    for (std::size_t i = 0; i < n; ++i) {
      const TrackPoint* part = latest[i].at(last.t_us);
      if (part == nullptr)
        whole = false;
      else
        parts[i] = *part;
    }
    if (!whole) continue;
    const auto correlation = [&](std::size_t i, std::size_t j) {
      return correlations[i * n + j].at(last.t_us).value_or(0);
    };
    auto point = of.derive({.parts = parts, .correlation = correlation, .flight = truth.flight});
    if (!point) continue;
    point->t_us = last.t_us;
    all.points.push_back(*point);
  }
  return all;
}

}  // namespace

Points points_of(const ReferenceQuantity& of, const MappedTarget& target, const checks::Observations& seen,
                 const Truth& truth) {
  return of.of.empty() ? reported(of, target, seen, truth) : derived(of, target, seen, truth);
}

double pages_of(const Hear& hear) {
  std::set<std::pair<std::string_view, std::uint64_t>> pages;
  for (const dbc::Signal& signal : hear.of.message->signals) {
    if (!signal.mux_ranges.empty()) pages.emplace(signal.multiplexed_by, signal.mux_ranges.front().first);
  }
  return static_cast<double>(std::max<std::size_t>(1, pages.size()));
}

double longest_wait_us(const checks::Observations& seen, const Hear& hear) {
  return pages_of(hear) * estimators::longest_wait_us(seen, hear.of.message->name);
}

const Hear& hear_of(const MappedTarget& target, const quantities::Quantity* quantity) {
  return *told(target, What::value, quantity).in;  // NOLINT(clang-analyzer-core.uninitialized.UndefReturn)
}

}  // namespace canhil::mapping
