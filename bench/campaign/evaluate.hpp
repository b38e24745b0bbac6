// Evaluates all metrics of a campaign and determines the verdict.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/campaign/answer.hpp"
#include "bench/campaign/campaign.hpp"
#include "bench/campaign/judged.hpp"
#include "bench/campaign/store.hpp"
#include "bench/checks/verdict.hpp"

namespace canhil::campaign {

/// How the runs of a variant ended.
struct Endings {
  std::string variant;
  std::size_t runs = 0;
  std::size_t completed = 0;
  std::size_t wrong =
      0;  ///< runs to their end that fail whatever the metrics say, for example by wrong causes
  std::size_t not_measured = 0;  ///< runs to their end that the bench could not judge
  std::size_t not_finite = 0;    ///< completed runs with values that are not finite
  std::string first_fault;       ///< for example "run 17: ..."; empty: all runs were completed
};

/// A flight of a campaign with faults.
struct Responded {
  Key key{};
  matrix::CellRun run{};
};

struct Evaluation {
  Identity identity{};  ///< of the results
  std::vector<Endings> endings;
  std::vector<Answer> answers;         ///< of the metrics, then of the checks
  std::vector<Responded> responses{};  ///< ordered by variant and run
  /// The reason why the verdict is neither pass nor fail; empty if it is pass or fail.
  [[nodiscard]] std::string not_judged() const;
  [[nodiscard]] checks::Outcome outcome() const;
};

/// Loads the runs of the variant with this index.
using Load = std::function<Result<std::vector<RunSeries>>(std::size_t)>;
/// Returns an Error if results cannot be read or if runs are missing.
Result<Evaluation> evaluate(const Campaign& campaign, const Load& load);
Result<Evaluation> evaluate(const Campaign& campaign, const Store& store);

}  // namespace canhil::campaign
