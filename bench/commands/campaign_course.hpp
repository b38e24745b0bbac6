// Passes the progress of a campaign's runs to the live view.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/execute.hpp"
#include "bench/campaign/judged.hpp"
#include "bench/campaign/row.hpp"
#include "bench/live/view.hpp"

namespace canhil::commands {

class Course {
 public:
  Course(const campaign::Campaign& campaign, live::View& view) : campaign_(campaign), view_(view) {}

  void committed(std::span<const campaign::Finished> runs) {
    for (const auto& [variant, series] : runs) {
      auto [result, failed] = result_of(series);
      batch_.failed += failed ? 1 : 0;
      batch_.add({.name = fmt::format("{} · run {}", campaign_.variants[variant].name, series.run),
                  .result = std::move(result),
                  .failed = failed});
    }
  }
  void progress(const campaign::Progress& progress, double elapsed_s) {
    batch_.done = progress.stored + progress.done;
    batch_.total = progress.stored + progress.total;
    batch_.rate_per_s = static_cast<double>(progress.done) / elapsed_s;
    view_.show(batch_);
  }
  void end(checks::Outcome outcome, std::string reason) {
    batch_.outcome = outcome;
    batch_.reason = std::move(reason);
    view_.show(batch_);
  }
  static live::Batch begun(const campaign::Campaign& campaign) {
    return {.title = campaign.matrix ? campaign.title : campaign.sources.file,
            .of = "runs",
            .total = campaign.runs * campaign.variants.size(),
            .failed_means = campaign.matrix   ? "violations"
                            : campaign.checks ? "failed"
                                              : "ended early"};
  }

 private:
  // The result of a run in words, and whether it failed.
  static std::pair<std::string, bool> result_of(const campaign::RunSeries& series) {
    const auto judged = campaign::judged_in(series.judged);
    if (judged && judged->response)
      return {to_text(judged->response->response),
              judged->response->response.kind == campaign::matrix::Response::Kind::violated};
    if (series.ending.kind != drive::Ending::Kind::completed) return {series.ending.detail, true};
    for (const checks::CheckResult& check : judged ? judged->checks : std::vector<checks::CheckResult>()) {
      if (check.outcome != checks::Outcome::pass)
        return {check.name + ": " + check.measured, check.outcome == checks::Outcome::fail};
    }
    return {"completed", false};
  }

  const campaign::Campaign& campaign_;
  live::View& view_;
  live::Batch batch_ = begun(campaign_);
};

}  // namespace canhil::commands
