#include "bench/campaign/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace canhil::campaign {
namespace {

// Whether all values are finite. A quantity that samples may lack (nan_allowed) may also be NaN.
bool finite(const quantities::Samples& samples) {
  const auto columns = samples.layout().kept;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
      const double value = samples.values(i)[column];
      if (!std::isfinite(value) && !(columns[column]->nan_allowed && std::isnan(value))) return false;
    }
  }
  return true;
}

bool was_not_measured(const RunSeries& run) {
  return run.ending.kind == drive::Ending::Kind::not_measured ||
         run.ending.kind == drive::Ending::Kind::plant_failed;
}

Endings endings_of(const Variant& variant, const Runs& runs) {
  Endings endings;
  endings.variant = variant.name;
  endings.runs = runs.size();
  for (const RunSeries& run : runs) {
    if (run.ending.kind == drive::Ending::Kind::wrong_answers ||
        run.ending.kind == drive::Ending::Kind::wrong_end)
      ++endings.wrong;
    if (was_not_measured(run)) ++endings.not_measured;
    if (run.ending.kind == drive::Ending::Kind::completed) {
      ++endings.completed;
      if (!finite(run.samples)) ++endings.not_finite;
    } else if (endings.first_fault.empty()) {
      endings.first_fault = fmt::format("run {}: {}", run.run, run.ending.detail);
    }
  }
  return endings;
}

Answer answer_to(const Campaign& campaign, const Metric& metric, std::size_t variant,
                 const std::vector<Runs>& runs) {
  Answer out{.metric = metric.name,
             .kind = std::string(kind(metric)),
             .requirement = metric.requirement,
             .variant = campaign.variants[variant].name};
  const std::string other = other_of(metric);
  const Runs& others = other.empty() ? runs[variant] : runs[counterpart(campaign, variant, other)];
  answer(metric, runs[variant], others, out);
  return out;
}

// A limit that is not met only because runs were not measured is not judged: it is no fault of the target.
Answer answer_of(const Campaign& campaign, const Metric& metric, std::size_t variant,
                 const std::vector<Runs>& runs) {
  Answer out = answer_to(campaign, metric, variant, runs);
  if (out.passed.value_or(true)) return out;
  std::vector<Runs> measured = runs;
  for (Runs& of : measured) std::erase_if(of, was_not_measured);
  if (std::ranges::equal(measured, runs, {}, &Runs::size, &Runs::size)) return out;
  const bool some = std::ranges::none_of(measured, &Runs::empty);
  if (!some || answer_to(campaign, metric, variant, measured).passed.value_or(true)) out.passed.reset();
  return out;
}

// Whether a limit is not met, or a run failed as a run of its own.
bool any_failed(const Evaluation& of) {
  return std::ranges::any_of(of.answers,
                             [](const Answer& answer) { return !answer.passed.value_or(true); }) ||
         std::ranges::any_of(of.endings, [](const Endings& one) { return one.wrong > 0; });
}

}  // namespace

std::string Evaluation::not_judged() const {
  if (any_failed(*this)) return {};
  if (answers.empty()) return "nothing was judged: no [[metric]]";
  const auto judged = [this](const std::string* variant) {
    return std::ranges::any_of(answers, [&](const Answer& answer) {
      return answer.passed && (variant == nullptr || answer.variant == *variant);
    });
  };
  if (!judged(nullptr)) return "nothing was judged: no [[metric]] has a limit";
  // In comparisons, a variant without completed runs counts as the worst one, so the other variants may pass.
  // Therefore at least one metric with a limit must judge the variant that has no completed runs.
  for (const Endings& one : endings) {
    if (one.not_measured > 0)
      return fmt::format("variant '{}': {} of {} runs were not measured ({})", one.variant, one.not_measured,
                         one.runs, one.first_fault);
    if (one.completed == 0 && !judged(&one.variant))
      return fmt::format(
          "variant '{}' was not judged: none of its runs was completed ({}), and it has no limit",
          one.variant, one.first_fault);
  }
  return {};
}

checks::Outcome Evaluation::outcome() const {
  if (any_failed(*this)) return checks::Outcome::fail;
  return not_judged().empty() ? checks::Outcome::pass : checks::Outcome::not_measured;
}

Result<Evaluation> evaluate(const Campaign& campaign, const Load& load) {
  Evaluation evaluation;
  std::vector<Runs> runs;
  for (std::size_t variant = 0; variant < campaign.variants.size(); ++variant) {
    auto loaded = load(variant);
    if (!loaded) return tl::unexpected(loaded.error());
    if (loaded->size() != campaign.runs) {
      return failure(fmt::format("variant '{}' has {} of {} runs, expected all: resume, or merge the shards",
                                 campaign.variants[variant].name, loaded->size(), campaign.runs));
    }
    const estimators::Estimator& estimator = estimators::of(campaign.variants[variant].scenario);
    const quantities::Freshness freshness = estimator.freshness(campaign.variants[variant].scenario);
    for (RunSeries& run : *loaded) {
      if (&run.samples.layout() != &estimator.layout)
        return failure(
            fmt::format("run {} of variant '{}' has samples of another estimator than its scenario", run.run,
                        campaign.variants[variant].name));
      run.freshness = freshness;
    }
    evaluation.endings.push_back(endings_of(campaign.variants[variant], *loaded));
    runs.push_back(std::move(*loaded));
  }
  for (const Metric& metric : campaign.metrics) {
    for (const std::size_t variant : variants_of(campaign, metric)) {
      evaluation.answers.push_back(answer_of(campaign, metric, variant, runs));
    }
  }
  return evaluation;
}

Result<Evaluation> evaluate(const Campaign& campaign, const Store& store) {
  auto evaluation = evaluate(campaign, [&](std::size_t variant) { return store.load(variant); });
  if (evaluation) evaluation->target = store.identity().target;
  return evaluation;
}

}  // namespace canhil::campaign
