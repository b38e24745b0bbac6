#include "bench/papers/flown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bench/campaign/execute.hpp"

namespace canhil::papers {
namespace {

// The campaigns are built into the program, and their names with them: a test asks for every one.
[[noreturn]] void no_such(std::string_view campaign, std::string_view what) {
  throw std::logic_error(fmt::format("campaign '{}': no {}", campaign, what));
}

template <class Wanted>
const campaign::Answer& find_answer(const Flown& flown, std::string_view variant, std::string_view point,
                                    Wanted&& wanted) {
  const std::string name = point.empty() ? std::string(variant) : fmt::format("{} {}", variant, point);
  for (const campaign::Answer& answer : flown.evaluation.answers) {
    if (answer.variant == name && wanted(answer)) return answer;
  }
  no_such(flown.name, fmt::format("such answer for '{}'", name));
}

Result<campaign::Campaign> read_embedded(const EmbeddedFile& file, std::span<const EmbeddedFile> scenarios) {
  return campaign::parse_campaign(
      file.text, fmt::format("{}.toml", file.name), [&](const std::string& name) -> Result<std::string> {
        const auto found = std::ranges::find_if(
            scenarios, [&](const EmbeddedFile& one) { return name == fmt::format("{}.toml", one.name); });
        if (found == scenarios.end()) no_such(file.name, fmt::format("scenario '{}'", name));
        return std::string(found->text);
      });
}

}  // namespace

std::span<const campaign::CurvePoint> Flown::curve(std::string_view variant, std::string_view point,
                                                   const campaign::Quantity& quantity) const {
  return find_answer(*this, variant, point,
                     [&](const campaign::Answer& answer) {
                       return answer.kind == campaign::RmsCurve::kind && answer.quantity == &quantity;
                     })
      .curve;
}

const campaign::Answer& Flown::answer(std::string_view metric, std::string_view variant,
                                      std::string_view point) const {
  return find_answer(*this, variant, point,
                     [&](const campaign::Answer& answer) { return answer.metric == metric; });
}

const campaign::Answer& Flown::answer_of_kind(std::string_view kind, std::string_view variant,
                                              std::string_view point) const {
  return find_answer(*this, variant, point,
                     [&](const campaign::Answer& answer) { return answer.kind == kind; });
}

std::vector<const campaign::Answer*> Flown::answers(std::string_view requirement) const {
  std::vector<const campaign::Answer*> found;
  for (const campaign::Answer& answer : evaluation.answers) {
    if (answer.requirement == requirement) found.push_back(&answer);
  }
  return found;
}

const Flown& of(const std::vector<Flown>& flown, std::string_view name) {
  const auto found = std::ranges::find(flown, name, &Flown::name);
  if (found == flown.end()) no_such(name, "results");
  return *found;
}

std::size_t flights(const std::vector<Flown>& flown) {
  std::size_t sum = 0;
  for (const Flown& one : flown) sum += one.campaign.variants.size() * one.campaign.runs;
  return sum;
}

void add_rms(Curve& curve, double x, const campaign::CurvePoint& point, double unit) {
  constexpr double of_95_percent = 1.96;  // standard deviations of a normal distribution
  const double rms = point.rms / unit;
  // On a logarithmic axis, on which RMS values are drawn, as far down as up: never below zero.
  const double times = std::exp(of_95_percent * point.rms_error / point.rms);
  curve.points.emplace_back(x, rms);
  curve.ranges.push_back(std::isfinite(times) ? std::pair(rms / times, rms * times) : std::pair(rms, rms));
}

double figure(const campaign::Answer& answer, std::string_view name) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto found = std::ranges::find_if(answer.figures, [&](const auto& one) { return one.first == name; });
  return found == answer.figures.end() ? nan : found->second.value_or(nan);
}

Rounding rounding_of(const std::vector<Flown>& flown) { return flown.front().campaign.rounding; }

std::string_view frames_flown(const std::vector<Flown>& flown) {
  return rounding_of(flown) == Rounding::none ? "frames without the bus's rounding (--unrounded)"
                                              : "frames quantised as on the bus";
}

Result<Flown> evaluated(std::string name, campaign::Campaign campaign, const campaign::Store& store) {
  auto evaluation = campaign::evaluate(campaign, store);
  if (!evaluation) return tl::unexpected(evaluation.error());
  return Flown{
      .name = std::move(name), .campaign = std::move(campaign), .evaluation = std::move(*evaluation)};
}

std::filesystem::path results_file(const FlyOptions& options, std::string_view campaign) {
  return options.folder / fmt::format("{}.sqlite", campaign);
}

Result<std::optional<std::vector<Flown>>> fly(const Campaigns& files, const FlyOptions& options,
                                              const std::atomic<bool>& stop) {
  std::vector<Flown> all;
  for (const EmbeddedFile& file : files.campaigns) {
    auto campaign = read_embedded(file, files.scenarios);
    if (!campaign) return tl::unexpected(campaign.error());
    if (options.runs) campaign->runs = *options.runs;
    campaign->rounding = options.rounding;
    const campaign::Options flying{.file = results_file(options, file.name),
                                   .shard = {},
                                   .threads = 0,
                                   .resume = true,
                                   .progress = [&](const campaign::Progress& p) {
                                     options.progress(file.name, p.stored + p.done, p.total);
                                   }};
    const auto ended = campaign::execute(*campaign, flying, stop);
    if (!ended) return tl::unexpected(ended.error());
    if (*ended == campaign::Execution::interrupted) return std::nullopt;
    const auto store = campaign::Store::open(flying.file);
    if (!store) return tl::unexpected(store.error());
    auto flown = evaluated(std::string(file.name), std::move(*campaign), *store);
    if (!flown) return tl::unexpected(flown.error());
    all.push_back(std::move(*flown));
  }
  return all;
}

}  // namespace canhil::papers
