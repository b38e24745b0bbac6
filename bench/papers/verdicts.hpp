// Rows of a table from the answers of a campaign.
#pragma once

#include <string>
#include <string_view>

#include "bench/papers/flown.hpp"
#include "bench/papers/page.hpp"

namespace canhil::papers {

/// A claim, what the paper and this run say, and the verdict in words.
Row verdict(std::string claim, std::string paper, std::string ours, Mark mark, std::string words);
/// The same: reproduces, or does not.
Row reproduces(std::string claim, std::string paper, std::string ours, bool yes);

/// A bar, what it asks and what was measured: pass or FAIL.
Row bar(std::string name, std::string asked, std::string measured, bool pass);
/// Adds the rows of every answer that carries a requirement.
void add_bars(Table& table, const Flown& flown, std::string_view requirement);
/// Whether there are answers that carry the requirement, and every one met its bars.
bool passed(const Flown& flown, std::string_view requirement);

}  // namespace canhil::papers
