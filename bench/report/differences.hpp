// How runs differ in their conditions rather than in their measurements; this may explain why one is slower.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace canhil::report {

/// Compares provenance and wire of all reports of one side with those of the other. One line for each thing,
/// "differs  seed: 7 -> 8"; a side whose runs differ among themselves lists its values: "7 and 9 -> 8". Left
/// out is what differs between any two runs: dates, folders of files, the bus that a bench made for itself.
std::string differences(const std::vector<nlohmann::ordered_json>& before,
                        const std::vector<nlohmann::ordered_json>& after);

}  // namespace canhil::report
