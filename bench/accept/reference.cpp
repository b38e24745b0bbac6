#include "bench/accept/reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "bench/report/file.hpp"
#include "dbc/files/text_file.hpp"
#include "messages/canhil.hpp"

namespace canhil::accept {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 22U;
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

std::vector<double> numbers(std::istringstream& line) {
  std::vector<double> all;
  for (double value = 0; line >> value;) all.push_back(value);
  return all;
}

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

Result<void> write(const Reference& reference, const std::filesystem::path& file,
                   const std::string& comment) {
  std::string text;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) text += fmt::format("# {}\n", line);
  for (const ReferenceMessage& message : reference) {
    text += fmt::format("message {} {}\nsignals {}\nrounding {:.3g}\nmean {:.15g}\nmean_rounding {:.3g}\n",
                        message.name, message.count, fmt::join(message.signals, " "),
                        fmt::join(message.rounding, " "), fmt::join(message.mean, " "),
                        fmt::join(message.mean_rounding, " "));
    for (const auto& row : message.rows)
      text += fmt::format("{} {:.6g} {:.12g}\n", row.index, row.t_s, fmt::join(row.values, " "));
  }
  return report::write_file(file.string(), text);
}

Result<Reference> read_reference(const std::filesystem::path& file) {
  const auto text = read_text_file(file, "a reference", most_bytes);
  if (!text) return tl::unexpected(text.error());
  Reference reference;
  std::istringstream lines{*text};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const auto wrong = [&](std::string_view expected) {
      return failure(
          fmt::format("{}:{}: '{}', expected {}", file.string(), number, line.substr(0, 40), expected));
    };
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (first == "message") {
      ReferenceMessage message;
      if (!(words >> message.name >> message.count))
        return wrong("the name of a message and how often it came");
      reference.push_back(std::move(message));
      continue;
    }
    if (reference.empty()) return wrong("a line 'message'");
    ReferenceMessage& message = reference.back();
    if (first == "signals") {
      for (std::string name; words >> name;) message.signals.push_back(name);
      continue;
    }
    std::size_t index = 0;
    double t_s = 0;
    if (first != "rounding" && first != "mean" && first != "mean_rounding") {
      const auto [end, bad] = std::from_chars(first.data(), first.data() + first.size(), index);
      if (bad != std::errc() || end != first.data() + first.size())
        return wrong("'message', 'signals', 'rounding', 'mean', 'mean_rounding' or the index of an answer");
      if (index >= message.count || !(words >> t_s))
        return wrong(fmt::format("the index of one of {} answers, and its time", message.count));
    }
    std::vector<double> values = numbers(words);
    if (values.size() != message.signals.size())
      return wrong(fmt::format("{} numbers, one per signal", message.signals.size()));
    if (first == "rounding") {
      message.rounding = std::move(values);
    } else if (first == "mean") {
      message.mean = std::move(values);
    } else if (first == "mean_rounding") {
      message.mean_rounding = std::move(values);
    } else {
      message.rows.push_back({.index = index, .t_s = t_s, .values = std::move(values)});
    }
  }
  for (const ReferenceMessage& message : reference) {
    for (const auto* numbers : {&message.rounding, &message.mean, &message.mean_rounding}) {
      if (numbers->size() != message.signals.size())
        return failure(fmt::format("{}: {} lacks a line, expected rounding, mean and mean_rounding",
                                   file.string(), message.name));
    }
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
