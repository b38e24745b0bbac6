// Evaluates all metrics of a campaign, and the verdict.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/campaign/answer.hpp"
#include "bench/campaign/campaign.hpp"
#include "bench/campaign/store.hpp"
#include "bench/checks/verdict.hpp"

namespace canhil::campaign {

/// How the runs of a variant ended.
struct Endings {
  std::string variant;
  std::size_t runs = 0;
  std::size_t completed = 0;
  std::size_t not_finite = 0;  ///< completed, but with values that are not finite
  std::string first_fault;     ///< "run 17: ..."; empty: none
};

struct Evaluation {
  std::string target{};  ///< see Identity
  std::vector<Endings> endings;
  std::vector<Answer> answers;
  /// The reason why a campaign without failures did not pass; empty: it failed or passed.
  [[nodiscard]] std::string not_judged() const;
  [[nodiscard]] checks::Outcome outcome() const;
};

/// Loads the runs of a variant.
using Load = std::function<Result<std::vector<RunSeries>>(std::size_t)>;
/// Error: results cannot be read, or runs are missing.
Result<Evaluation> evaluate(const Campaign& campaign, const Load& load);
Result<Evaluation> evaluate(const Campaign& campaign, const Store& store);

}  // namespace canhil::campaign
