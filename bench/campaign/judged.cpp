#include "bench/campaign/judged.hpp"

#include <nlohmann/json.hpp>

#include "bench/checks/result_json.hpp"

namespace canhil::campaign {

using Json = nlohmann::ordered_json;

std::string to_text(const Judged& judged) {
  Json json = Json::object();
  for (const checks::CheckResult& check : judged.checks) json["checks"].push_back(checks::json_of(check));
  if (judged.response) json["response"] = matrix::json_of(*judged.response);
  // File names may contain bytes that are not UTF-8; such bytes are replaced.
  return json.empty() ? "" : json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<Judged> judged_in(const std::string& text) {
  Judged judged;
  if (text.empty()) return judged;
  try {
    const Json json = Json::parse(text);
    if (json.contains("checks")) {
      for (const Json& check : json["checks"]) judged.checks.push_back(checks::result_in(check));
    }
    if (json.contains("response")) judged.response = matrix::cell_run_in(json["response"]);
  } catch (const Json::exception& error) {
    return failure(error.what());
  }
  return judged;
}

}  // namespace canhil::campaign
