#include "bench/papers/paper.hpp"

#include <fmt/format.h>

#include "bench/campaign/store.hpp"
#include "bench/papers/gnuplot.hpp"
#include "bench/papers/transfer_alignment/reproduction.hpp"
#include "bench/papers/transfer_alignment/sections.hpp"
#include "bench/report/file.hpp"
#include "bench/run/contract.hpp"

namespace canhil::papers {

Result<Reproduced> reproduce(const Request& request, const std::atomic<bool>& stop) {
  if (request.paper != "transfer")
    return failure(fmt::format("paper '{}' is unknown, expected transfer", request.paper));
  if (request.runs == 0U) return failure("--runs 0: expected at least 1");
  if (!request.exact.empty() && !run::frames_round())
    return failure("--exact: this program rounds nothing itself, expected hil-bench to compare with");
  std::error_code error;
  std::filesystem::create_directories(request.folder, error);
  if (error)
    return failure(fmt::format("folder '{}': cannot be made: {}", request.folder.string(), error.message()));
  Reproduced reproduced;
  reproduced.page = request.folder / "transfer.html";
  if (auto writable = report::check_writable(reproduced.page.string()); !writable)
    return tl::unexpected(writable.error());
  if (auto there = check_gnuplot(); !there) return tl::unexpected(there.error());

  if (!request.exact.empty()) {
    if (auto there = campaign::Store::open(request.exact); !there) return tl::unexpected(there.error());
  }

  const auto results = transfer_alignment::fly(
      {.folder = request.folder, .runs = request.runs, .exact = request.exact, .progress = request.progress},
      stop);
  if (!results) return tl::unexpected(results.error());
  if (!*results) return reproduced;
  const Page page = transfer_alignment::page(**results);
  const auto drawn = html(page);
  if (!drawn) return tl::unexpected(drawn.error());
  if (auto written = report::write_file(reproduced.page.string(), *drawn); !written)
    return tl::unexpected(written.error());
  reproduced.text = text(page);
  reproduced.outcome = transfer_alignment::bars_met(**results) ? Outcome::bars_met : Outcome::bars_missed;
  return reproduced;
}

}  // namespace canhil::papers
