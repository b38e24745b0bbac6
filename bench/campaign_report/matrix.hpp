// Formats the responses of a campaign with faults as a matrix.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/evaluate.hpp"

namespace canhil::campaign {

/// The matrix, followed by the cells that were not measured and by the violations, each with the command that
/// repeats the violation. `folder`: the folder of the saved scenarios.
std::string matrix_text(const Campaign& campaign, const Evaluation& evaluation,
                        const std::filesystem::path& folder);
/// The matrix as Markdown tables.
std::string matrix_markdown(const Campaign& campaign, const Evaluation& evaluation);
/// The keys `columns`, `rows` and `cells` of a report.
void add_matrix(nlohmann::ordered_json& json, const Campaign& campaign, const Evaluation& evaluation);
/// The sections of a page.
std::string matrix_html(const Campaign& campaign, const Evaluation& evaluation,
                        const std::filesystem::path& folder);

}  // namespace canhil::campaign
