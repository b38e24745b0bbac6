// Finds differences between the conditions of runs, not between their measurements. A different condition may
// explain why one run is slower.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace canhil::report {

/// Compares the provenance and the bit rates in all reports of one side with those of the other side. One
/// line for each difference, "differs  seed: 7 -> 8"; if the runs of a side differ among themselves, the line
/// lists their values: "7 and 9 -> 8". Values that always differ from run to run are left out: dates, folders
/// of files, the bus that a bench made for itself.
std::string differences(const std::vector<nlohmann::ordered_json>& before,
                        const std::vector<nlohmann::ordered_json>& after);

}  // namespace canhil::report
