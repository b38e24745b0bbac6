#include "bench/campaign/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "bench/campaign/check_answers.hpp"

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

bool violated(const Responded& flight) {
  return flight.run.response.kind == matrix::Response::Kind::violated;
}

// Whether a limit is not met, a response violates a requirement, or a run failed as a run of its own.
bool any_failed(const Evaluation& of) {
  return std::ranges::any_of(of.answers, [](const Answer& one) { return one.passed == false; }) ||
         std::ranges::any_of(of.responses, violated) ||
         (of.responses.empty() &&
          std::ranges::any_of(of.endings, [](const Endings& one) { return one.wrong > 0; }));
}

// Adds what was judged in each run.
Result<void> add_judged(const Campaign& campaign, std::size_t variant, const Runs& runs, Evaluation& out) {
  std::vector<Judged> all;
  for (const RunSeries& run : runs) {
    auto judged = judged_in(run.judged);
    if (judged && campaign.matrix.has_value() != judged->response.has_value())
      judged = failure("holds no response to faults, or one too many");
    if (!judged)
      return failure(fmt::format("run {} of variant '{}': {}", run.run, campaign.variants[variant].name,
                                 judged.error().message));
    if (judged->response)
      out.responses.push_back({.key = {.variant = variant, .run = run.run}, .run = *judged->response});
    all.push_back(std::move(*judged));
  }
  if (campaign.checks && !campaign.matrix)
    std::ranges::move(answers_of_checks(campaign, variant, runs, all), std::back_inserter(out.answers));
  return {};
}

}  // namespace

std::string Evaluation::not_judged() const {
  if (any_failed(*this)) return {};
  const auto unjudged = std::ranges::find_if(responses, [](const Responded& flight) {
    return flight.run.response.kind == matrix::Response::Kind::not_measured;
  });
  if (unjudged != responses.end())
    return fmt::format("run {} of variant '{}' was not measured ({})", unjudged->key.run,
                       endings[unjudged->key.variant].variant, unjudged->run.response.why);
  if (answers.empty() && !responses.empty()) return {};
  if (answers.empty()) return "nothing was judged: no [[metric]] and no [[check]]";
  const auto judged = [this](const std::string* variant) {
    return std::ranges::any_of(answers, [&](const Answer& answer) {
      return answer.passed && (variant == nullptr || answer.variant == *variant);
    });
  };
  const auto unmeasured = std::ranges::find_if(
      answers, [](const Answer& answer) { return answer.outcome() == checks::Outcome::not_measured; });
  if (!judged(nullptr) && unmeasured == answers.end() && responses.empty())
    return "nothing was judged: no [[metric]] has a limit";
  // In comparisons, a variant without completed runs counts as the worst one, so the other variants may pass.
  // Therefore at least one metric with a limit must judge the variant that has no completed runs.
  for (const Endings& one : endings) {
    if (one.not_measured > 0)
      return fmt::format("variant '{}': {} of {} runs were not measured ({})", one.variant, one.not_measured,
                         one.runs, one.first_fault);
    if (one.completed == 0 && !judged(&one.variant) && responses.empty())
      return fmt::format(
          "variant '{}' was not judged: none of its runs was completed ({}), and it has no limit",
          one.variant, one.first_fault);
  }
  if (unmeasured != answers.end())
    return fmt::format("'{}' of variant '{}' was not measured ({})", unmeasured->metric, unmeasured->variant,
                       unmeasured->measured);
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
      if (keeps_samples(campaign) && &run.samples.layout() != &estimator.layout)
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
  for (std::size_t variant = 0; variant < runs.size(); ++variant) {
    if (auto added = add_judged(campaign, variant, runs[variant], evaluation); !added)
      return tl::unexpected(added.error());
  }
  // The answers of a check stand together, as those of a metric do.
  std::vector<std::string> names;
  for (const Answer& answer : evaluation.answers) {
    if (std::ranges::find(names, answer.metric) == names.end()) names.push_back(answer.metric);
  }
  std::ranges::stable_sort(evaluation.answers, {}, [&](const Answer& answer) {
    return std::ranges::find(names, answer.metric) - names.begin();
  });
  return evaluation;
}

Result<Evaluation> evaluate(const Campaign& campaign, const Store& store) {
  auto evaluation = evaluate(campaign, [&](std::size_t variant) { return store.load(variant); });
  if (evaluation) evaluation->identity = store.identity();
  return evaluation;
}

}  // namespace canhil::campaign
