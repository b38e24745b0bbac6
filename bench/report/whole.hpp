// Whether a report says what a comparison or a page takes from it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace canhil::report {

/// Empty: it does. Else what is wrong: "key 'latency_s.A.p50': is null, expected a number".
std::string why_not_whole(const nlohmann::ordered_json& report);

}  // namespace canhil::report
