// Computes the content of a paper's page from the results of the campaigns: the values of the names in the
// templates, the curves, and whether the limits are met. The prose is in page.mustache and the other
// templates in the paper's folder.
#pragma once

#include <filesystem>

#include "bench/papers/document.hpp"
#include "bench/papers/flown.hpp"

namespace canhil::papers {

struct PageContent {
  Names names{};  ///< names in addition to those of add_shared_names()
  Curves curves{};
  bool bars_met = false;
};

/// Adds the names that all papers have:
/// - runs, enough, flights, frames, #too_few_runs, #unrounded;
/// - {{bars CAMPAIGN REQUIREMENT}}: a row for every answer with that requirement;
/// - {{reproduces NAME}} and {{pass NAME}}: the verdict of a boolean name.
/// `runs`: the number of runs of the campaign that has the limits. `enough`: the number of runs for which the
/// limits were derived.
void add_shared_names(Names& names, const Results& results, std::uint64_t runs, std::uint64_t enough);

// Each of the following namespaces belongs to one paper. It contains the files that are built into the
// program (bench/monte_carlo/paper_NAME and its templates), and a function that computes the content of the
// paper's page. The content keeps references to the results. `exact` is only used for the transfer paper: a
// file with results of its campaign table2 that was flown without rounding on the bus; empty: no such file.
// If stored results cannot be read, the error is one line of text.
namespace transfer_alignment {
extern const EmbeddedFiles campaigns, scenarios, templates;
Result<PageContent> page_content(const Results& results, const FlyOptions& options,
                                 const std::filesystem::path& exact);
}  // namespace transfer_alignment

namespace inflight_alignment {
extern const EmbeddedFiles campaigns, scenarios, templates;
Result<PageContent> page_content(const Results& results, const FlyOptions& options,
                                 const std::filesystem::path& exact);
}  // namespace inflight_alignment

namespace los_rate {
extern const EmbeddedFiles campaigns, scenarios, templates;
Result<PageContent> page_content(const Results& results, const FlyOptions& options,
                                 const std::filesystem::path& exact);
}  // namespace los_rate

namespace wind {
extern const EmbeddedFiles campaigns, scenarios, templates;
Result<PageContent> page_content(const Results& results, const FlyOptions& options,
                                 const std::filesystem::path& exact);
}  // namespace wind

}  // namespace canhil::papers
