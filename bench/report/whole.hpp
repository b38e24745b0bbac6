// Whether a report contains everything that a comparison or a page needs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace canhil::report {

/// Returns why a report is incomplete, such as "key 'latency_s.A.p50': is null, expected a number". Empty:
/// the report is complete.
std::string why_not_whole(const nlohmann::ordered_json& report);

}  // namespace canhil::report
