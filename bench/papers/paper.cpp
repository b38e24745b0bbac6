#include "bench/papers/paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/campaign/store.hpp"
#include "bench/papers/gnuplot.hpp"
#include "bench/papers/inflight_alignment/reproduction.hpp"
#include "bench/papers/los_rate/reproduction.hpp"
#include "bench/papers/names.hpp"
#include "bench/papers/transfer_alignment/reproduction.hpp"
#include "bench/papers/wind/reproduction.hpp"
#include "bench/report/file.hpp"

namespace canhil::papers {
namespace {

// The papers: what a new one joins.
struct Paper {
  std::string_view name;
  Result<std::optional<Reproduction>> (*reproduce)(const FlyOptions& options,
                                                   const std::filesystem::path& exact,
                                                   const std::atomic<bool>& stop);
  bool compares = false;  // with results without rounding
};
constexpr std::array papers{
    Paper{.name = "transfer", .reproduce = transfer_alignment::reproduce, .compares = true},
    Paper{.name = "inflight", .reproduce = inflight_alignment::reproduce},
    Paper{.name = "los", .reproduce = los_rate::reproduce},
    Paper{.name = "wind", .reproduce = wind::reproduce}};
static_assert(std::ranges::equal(papers, paper_names, {}, &Paper::name));

Result<Paper> find_paper(std::string_view name) {
  const auto found = std::ranges::find(papers, name, &Paper::name);
  if (found != papers.end()) return *found;
  return failure(fmt::format("paper '{}' is unknown, expected {}", name, names()));
}

bool too_few_runs(const Reproduction& reproduction) { return reproduction.runs < reproduction.enough; }

Page with_caveat(const Reproduction& reproduction) {
  Page page = reproduction.page;
  if (too_few_runs(reproduction))
    page.subtitle +=
        fmt::format(" The bars are for {} runs: with fewer they may fail by chance.", reproduction.enough);
  return page;
}

}  // namespace

Outcome outcome_of(const Reproduction& reproduction) {
  if (reproduction.bars_met) return Outcome::bars_met;
  return too_few_runs(reproduction) ? Outcome::too_few_runs : Outcome::bars_missed;
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
  std::error_code error;
  std::filesystem::create_directories(request.folder, error);
  if (error)
    return failure(fmt::format("folder '{}': cannot be made: {}", request.folder.string(), error.message()));
  Reproduced reproduced;
  reproduced.page = request.folder / fmt::format("{}.html", request.paper);
  if (auto writable = report::check_writable(reproduced.page.string()); !writable)
    return tl::unexpected(writable.error());
  if (auto there = check_gnuplot(); !there) return tl::unexpected(there.error());

  if (!request.exact.empty()) {
    if (auto there = campaign::Store::open(request.exact); !there) return tl::unexpected(there.error());
  }

  const auto written = paper->reproduce({.folder = request.folder,
                                         .runs = request.runs,
                                         .rounding = request.rounding,
                                         .progress = request.progress},
                                        request.exact, stop);
  if (!written) return tl::unexpected(written.error());
  if (!*written) return reproduced;
  const Reproduction& judged = **written;
  const Page page = with_caveat(judged);
  const auto drawn = html(page);
  if (!drawn) return tl::unexpected(drawn.error());
  if (auto saved = report::write_file(reproduced.page.string(), *drawn); !saved)
    return tl::unexpected(saved.error());
  reproduced.text = text(page);
  reproduced.outcome = outcome_of(judged);
  return reproduced;
}

}  // namespace canhil::papers
