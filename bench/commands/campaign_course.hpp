// Passes the progress of a campaign's runs to the live view.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/execute.hpp"
#include "bench/campaign/row.hpp"
#include "bench/live/view.hpp"

namespace canhil::commands {

class Course {
 public:
  Course(const campaign::Campaign& campaign, live::View& view) : campaign_(campaign), view_(view) {}

  void committed(std::span<const campaign::Finished> runs) {
    for (const auto& [variant, series] : runs) {
      const bool ended = series.ending.kind != drive::Ending::Kind::completed;
      batch_.failed += ended ? 1 : 0;
      batch_.add({.name = fmt::format("{} · run {}", campaign_.variants[variant].name, series.run),
                  .result = ended ? series.ending.detail : "completed",
                  .failed = ended});
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
  static live::Batch begun(const std::string& title, std::uint64_t total) {
    return {.title = title, .of = "runs", .total = total, .failed_means = "ended early"};
  }

 private:
  const campaign::Campaign& campaign_;
  live::View& view_;
  live::Batch batch_ = begun(campaign_.sources.file, 0);
};

}  // namespace canhil::commands
