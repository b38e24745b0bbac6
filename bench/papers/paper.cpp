#include "bench/papers/paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/campaign/store.hpp"
#include "bench/papers/gnuplot.hpp"
#include "bench/papers/names.hpp"
#include "bench/papers/page_content.hpp"
#include "bench/report/file.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::papers {
namespace {

// A new paper must be added to `papers` below and to paper_names.
struct Paper {
  std::string_view name;
  const EmbeddedFiles &campaigns, &scenarios, &templates;
  Result<PageContent> (*page_content)(const Results& results, const FlyOptions& options,
                                      const std::filesystem::path& exact);
  std::string_view judged;  // the campaign with the limits
  std::uint64_t enough;     // number of runs for which the limits were derived
  bool compares = false;    // compares with results without rounding
};
constexpr std::array papers{Paper{.name = "transfer",
                                  .campaigns = transfer_alignment::campaigns,
                                  .scenarios = transfer_alignment::scenarios,
                                  .templates = transfer_alignment::templates,
                                  .page_content = transfer_alignment::page_content,
                                  .judged = "table2",
                                  .enough = 300,
                                  .compares = true},
                            Paper{.name = "inflight",
                                  .campaigns = inflight_alignment::campaigns,
                                  .scenarios = inflight_alignment::scenarios,
                                  .templates = inflight_alignment::templates,
                                  .page_content = inflight_alignment::page_content,
                                  .judged = "ssbl",
                                  .enough = 400},
                            Paper{.name = "los",
                                  .campaigns = los_rate::campaigns,
                                  .scenarios = los_rate::scenarios,
                                  .templates = los_rate::templates,
                                  .page_content = los_rate::page_content,
                                  .judged = "open_loop",
                                  .enough = 200},
                            Paper{.name = "wind",
                                  .campaigns = wind::campaigns,
                                  .scenarios = wind::scenarios,
                                  .templates = wind::templates,
                                  .page_content = wind::page_content,
                                  .judged = "table1",
                                  .enough = 50}};
static_assert(std::ranges::equal(papers, paper_names, {}, &Paper::name));

Result<Paper> find_paper(std::string_view name) {
  const auto found = std::ranges::find(papers, name, &Paper::name);
  if (found != papers.end()) return *found;
  return failure(fmt::format("paper '{}' is unknown, expected {}", name, names()));
}

}  // namespace

Outcome outcome_of(bool bars_met, std::uint64_t runs, std::uint64_t enough) {
  if (bars_met) return Outcome::bars_met;
  return runs < enough ? Outcome::too_few_runs : Outcome::bars_missed;
}

Result<Reproduced> reproduce(const Request& request, const std::atomic<bool>& stop) {
  const auto paper = find_paper(request.paper);
  if (!paper) return tl::unexpected(paper.error());
  if (!request.exact.empty() && !paper->compares)
    return failure(
        fmt::format("--exact: paper '{}' compares with no results without rounding, expected with "
                    "--paper transfer",
                    request.paper));
  if (request.runs == 0U) return failure("--runs 0: expected at least 1");
  if (!request.exact.empty() && request.rounding == Rounding::none)
    return failure(
        "--exact: with --unrounded nothing rounds that could be compared, expected one of the two");
  Reproduced reproduced;
  reproduced.page = request.folder / fmt::format("{}.html", request.paper);
  const FlyOptions options{.folder = request.folder,
                           .runs = request.runs,
                           .rounding = request.rounding,
                           .progress = request.progress};
  CommandFiles files;
  files.reads("--exact", request.exact.string());
  for (const EmbeddedFile& campaign : paper->campaigns)
    files.may_write("results", results_file(options, campaign.name).string());
  files.writes_file("page", reproduced.page.string());
  if (auto distinct = files.check_distinct(); !distinct) return tl::unexpected(distinct.error());
  std::error_code error;
  std::filesystem::create_directories(request.folder, error);
  if (error)
    return failure(fmt::format("folder '{}': cannot be made: {}", request.folder.string(), error.message()));
  if (auto writable = files.check_writable(); !writable) return tl::unexpected(writable.error());
  if (auto there = check_gnuplot(); !there) return tl::unexpected(there.error());

  if (!request.exact.empty()) {
    if (auto there = campaign::Store::open(request.exact); !there) return tl::unexpected(there.error());
  }

  const auto flown = fly(paper->campaigns, paper->scenarios, options, stop);
  if (!flown) return tl::unexpected(flown.error());
  if (!*flown) return reproduced;
  const Results& results = **flown;
  auto content = paper->page_content(results, options, request.exact);
  if (!content) return tl::unexpected(content.error());
  const std::uint64_t runs = results.of(paper->judged).campaign.runs;
  add_shared_names(content->names, results, runs, paper->enough);
  const Page page = page_of(filled(paper->templates, content->names), content->curves);
  const auto drawn = html(page);
  if (!drawn) return tl::unexpected(drawn.error());
  if (auto saved = report::write_file(reproduced.page.string(), *drawn); !saved)
    return tl::unexpected(saved.error());
  reproduced.text = text(page);
  reproduced.outcome = outcome_of(content->bars_met, runs, paper->enough);
  return reproduced;
}

}  // namespace canhil::papers
