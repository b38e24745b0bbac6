#include "bench/papers/flown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bench/campaign/execute.hpp"

namespace canhil::papers {
namespace {

// Reports an error of the program: the names of campaigns are built in, and a test requests each of them.
[[noreturn]] void no_such(std::string_view campaign, std::string_view what) {
  throw std::logic_error(fmt::format("campaign '{}': no {}", campaign, what));
}

template <class Wanted>
const campaign::Answer& find_answer(const Flown& flown, std::string_view variant, Wanted&& wanted) {
  for (const campaign::Answer& answer : flown.evaluation.answers) {
    if (answer.variant == variant && wanted(answer)) return answer;
  }
  no_such(flown.name, fmt::format("such answer for '{}'", variant));
}

Result<campaign::Campaign> read_embedded(const EmbeddedFile& file, EmbeddedFiles scenarios) {
  return campaign::parse_campaign(
      file.text, fmt::format("{}.toml", file.name), [&](const std::string& name) -> Result<std::string> {
        const auto found = std::ranges::find_if(
            scenarios, [&](const EmbeddedFile& one) { return name == fmt::format("{}.toml", one.name); });
        if (found == scenarios.end()) no_such(file.name, fmt::format("scenario '{}'", name));
        return std::string(found->text);
      });
}

}  // namespace

std::span<const campaign::CurvePoint> Flown::curve(std::string_view variant,
                                                   const campaign::Quantity& quantity) const {
  return find_answer(*this, variant,
                     [&](const campaign::Answer& answer) {
                       return answer.kind == campaign::RmsCurve::kind && answer.quantity == &quantity;
                     })
      .curve;
}

const campaign::Answer& Flown::answer(std::string_view metric, std::string_view variant) const {
  return find_answer(*this, variant, [&](const campaign::Answer& answer) { return answer.metric == metric; });
}

const campaign::Answer& Flown::answer_of_kind(std::string_view kind, std::string_view variant) const {
  return find_answer(*this, variant, [&](const campaign::Answer& answer) { return answer.kind == kind; });
}

std::vector<const campaign::Answer*> Flown::answers(std::string_view requirement) const {
  std::vector<const campaign::Answer*> found;
  for (const campaign::Answer& answer : evaluation.answers) {
    if (answer.requirement == requirement) found.push_back(&answer);
  }
  return found;
}

bool passed(const Flown& flown, std::string_view requirement) {
  const auto answers = flown.answers(requirement);
  return !answers.empty() &&
         std::ranges::all_of(answers, [](const auto* answer) { return answer->passed.value_or(false); });
}

const Flown& Results::of(std::string_view name) const {
  const auto found = std::ranges::find(campaigns, name, &Flown::name);
  if (found == campaigns.end()) no_such(name, "results");
  return *found;
}

std::span<const campaign::CurvePoint> Results::curve(Words& words, const campaign::Quantity& quantity) const {
  const Flown& flown = of(words.next());
  return flown.curve(words.rest(), quantity);
}

void add_rms(Curve& curve, double x, const campaign::CurvePoint& point, double unit) {
  constexpr double of_95_percent = 1.96;  // standard deviations of a normal distribution
  const double rms = point.rms / unit;
  // The 95 % range reaches from rms / times to rms * times. So the range is symmetric on a logarithmic axis,
  // which the figures of RMS values have, and it is never below zero.
  const double times = std::exp(of_95_percent * point.rms_error / point.rms);
  curve.points.emplace_back(x, rms);
  curve.ranges.push_back(std::isfinite(times) ? std::pair(rms / times, rms * times) : std::pair(rms, rms));
}

Curve over_time(std::span<const campaign::CurvePoint> points, double unit, std::size_t step) {
  Curve curve;
  for (std::size_t i = 0; i < points.size(); i += step)
    add_rms(curve, static_cast<double>(points[i].t_us) * 1e-6, points[i], unit);
  return curve;
}

double figure(const campaign::Answer& answer, std::string_view name) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto found = std::ranges::find_if(answer.figures, [&](const auto& one) { return one.first == name; });
  return found == answer.figures.end() ? nan : found->second.value_or(nan);
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

Result<std::optional<Results>> fly(EmbeddedFiles campaigns, EmbeddedFiles scenarios,
                                   const FlyOptions& options, const std::atomic<bool>& stop) {
  Results results;
  for (const EmbeddedFile& file : campaigns) {
    auto campaign = read_embedded(file, scenarios);
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
    results.campaigns.push_back(std::move(*flown));
  }
  return results;
}

}  // namespace canhil::papers
