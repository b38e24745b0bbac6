#include "bench/report/flags.hpp"

#include <algorithm>

#include "bench/estimators/registry.hpp"
#include "bench/report/summary.hpp"
#include "bench/scenario/binding.hpp"

namespace canhil::report {
namespace {

std::vector<std::pair<std::int64_t, bool>> changes(const Spool<std::int64_t>& all,
                                                   const Spool<std::int64_t>& set) {
  std::vector<std::pair<std::int64_t, bool>> found;
  estimators::each_state(all, set, [&](std::int64_t t_us, bool is_set) {
    if (found.empty() || found.back().second != is_set) found.emplace_back(t_us, is_set);
  });
  return found;
}

}  // namespace

void give_flags(const scenario::Scenario& scenario, const drive::Run& run, const FlagOf& give) {
  const std::vector<std::string>& flags = scenario.binding->flags;
  if (is_cut_off(run) || flags.empty()) return;
  for (const estimators::Estimator* one : estimators::in(scenario)) {
    if (!scenario.runs(one->name)) continue;
    const std::vector<estimators::Mark> marks = one->marks(run.seen);
    for (const estimators::Mark& mark : marks) {
      const auto all = std::ranges::find(marks, mark.among, &estimators::Mark::name);
      const bool is_flag = std::ranges::find(flags, mark.name) != flags.end();
      if (!is_flag || all == marks.end() || all->t_us.empty()) continue;
      give(one->name, mark.name, changes(all->t_us, mark.t_us));
    }
  }
}

}  // namespace canhil::report
