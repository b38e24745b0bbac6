#include "bench/accept/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "messages/canhil.hpp"

namespace canhil::accept {
namespace {

constexpr double at_an_instant = 2, in_the_mean = 0.25, of_rounding = 4;

/// The value with the largest deviation. Each deviation is divided by its tolerance before it is compared.
struct Worst {
  double tolerances = 0;
  std::string text;
  void take(double off, double tolerance, const auto& say) {
    if (!(off > tolerance) && std::isfinite(off)) return;
    const double now = std::isfinite(off) ? off / std::max(tolerance, 1e-12) : HUGE_VAL;
    if (!text.empty() && now <= tolerances) return;
    tolerances = now;
    text = say();
  }
};

bool counts(const SignalInfo& signal) { return wire::lsb(signal) == 1; }

}  // namespace

Reference make_reference(const Answers& answers, const Answers& unrounded, std::size_t rows) {
  Reference reference;
  for (const auto& [name, series] : answers.messages()) {
    ReferenceMessage message{.name = name, .count = series.size()};
    const Series* plain = unrounded.find(name);
    for (std::size_t s = 0; s < series.signals.size(); ++s) {
      const SignalInfo& signal = *series.signals[s];
      message.signals.emplace_back(signal.name);
      message.mean.push_back(series.mean(s));
      double largest = 0;
      const std::size_t both = plain == nullptr ? 0 : std::min(series.size(), plain->size());
      for (std::size_t i = 0; i < both; ++i)
        largest = std::max(largest, distance(signal, series.value(i, s), plain->value(i, s)));
      message.rounding.push_back(largest);
      message.mean_rounding.push_back(plain == nullptr ? 0 : std::abs(series.mean(s) - plain->mean(s)));
    }
    const std::size_t kept = std::min(rows, series.size());
    for (std::size_t k = 0; k < kept; ++k) {
      const std::size_t index = kept == 1 ? 0 : k * (series.size() - 1) / (kept - 1);
      ReferenceMessage::Row row{.index = index, .t_s = series.t_s[index], .values = {}};
      for (std::size_t s = 0; s < series.signals.size(); ++s) row.values.push_back(series.value(index, s));
      message.rows.push_back(std::move(row));
    }
    reference.push_back(std::move(message));
  }
  return reference;
}

std::string departure(const Reference& reference, const Answers& answers, double share) {
  Worst worst;
  for (const ReferenceMessage& message : reference) {
    const Series* series = answers.find(message.name);
    const std::size_t count = series == nullptr ? 0 : series->size();
    if (series != nullptr && series->signals.size() != message.signals.size())
      return fmt::format("{}: has other signals than the reference", message.name);
    if (count != message.count)
      return fmt::format("{}: {} answers, {} in the reference", message.name, count, message.count);
    if (series == nullptr) continue;
    for (std::size_t s = 0; s < message.signals.size(); ++s) {
      const SignalInfo& signal = *series->signals[s];
      const double step = wire::lsb(signal), effect = of_rounding * message.rounding[s];
      const double tolerance = share * (counts(signal) ? effect : at_an_instant * step + effect);
      for (const auto& row : message.rows) {
        const double now = series->value(row.index, s);
        worst.take(distance(signal, now, row.values[s]), tolerance, [&] {
          return fmt::format("{}.{} at t={:g} s: {:.7g} {}, reference {:.7g} +- {:.2g}", message.name,
                             signal.name, row.t_s, now, signal.unit, row.values[s], tolerance);
        });
      }
      if (signal.name.ends_with("_counter") || signal.name.ends_with("_us"))
        continue;  // the mean of a counter or of a time of validity has no meaning
      const double now = series->mean(s);
      const double mean_tolerance =
          share * ((counts(signal) ? 1.01 / static_cast<double>(count) : in_the_mean * step) +
                   of_rounding * message.mean_rounding[s]);
      worst.take(distance(signal, now, message.mean[s]), mean_tolerance, [&] {
        return fmt::format("{}.{} over the flight: mean {:.7g} {}, reference {:.7g} +- {:.2g}", message.name,
                           signal.name, now, signal.unit, message.mean[s], mean_tolerance);
      });
    }
  }
  for (const auto& [name, series] : answers.messages()) {
    if (std::ranges::find(reference, name, &ReferenceMessage::name) == reference.end())
      return fmt::format("{}: {} answers, none in the reference", name, series.size());
  }
  return worst.text;
}

std::string difference(const Answers& one, const Answers& other, double steps, double relative) {
  Worst worst;
  for (const auto& message : one.messages()) {
    const std::string& name = message.first;
    const Series& series = message.second;
    if (name == messages::TargetHeartbeat::info.name) continue;
    const Series* against = other.find(name);
    if (against == nullptr || against->size() != series.size())
      return fmt::format("{}: {} answers in one, {} in the other", name, series.size(),
                         against == nullptr ? 0 : against->size());
    for (std::size_t s = 0; s < series.signals.size(); ++s) {
      const SignalInfo& signal = *series.signals[s];
      for (std::size_t i = 0; i < series.size(); ++i) {
        const double a = series.value(i, s), b = against->value(i, s);
        const double tolerance = counts(signal) ? 0 : steps * wire::lsb(signal) + relative * std::abs(b);
        worst.take(distance(signal, a, b), tolerance, [&] {
          return fmt::format("{}.{} at t={:g} s: {:.7g} in one, {:.7g} in the other", name, signal.name,
                             series.t_s[i], a, b);
        });
      }
    }
  }
  return worst.text;
}

}  // namespace canhil::accept
