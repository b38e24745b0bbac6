// Makes the scenario of a flight of the matrix, in memory or as a self-contained file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/campaign/matrix/matrix.hpp"
#include "bench/campaign/matrix/response.hpp"
#include "bench/checks/judge.hpp"
#include "bench/drive/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::campaign::matrix {
namespace {

using scenario::Setting;

Setting setting(std::string key, std::string value) {
  return {.key = std::move(key), .value = std::move(value), .elements = {}};
}

// The values of a flight that differ from those in the scenario's file.
std::vector<Setting> settings_of(const Column& column, std::uint64_t run,
                                 const std::vector<FaultText>& faults, std::int64_t duration_us,
                                 const std::vector<std::string>& checks) {
  std::string all;
  for (const FaultText& fault : faults) all += (all.empty() ? "" : ", ") + fault.in_line();
  std::vector<Setting> settings = column.settings;
  settings.push_back(setting("check", fmt::format("[{}]", fmt::join(checks, ", "))));
  settings.push_back(setting("seed", std::to_string(column.scenario.seed + run)));
  if (duration_us > 0)
    settings.push_back(setting("duration_s", fmt::format("{}", static_cast<double>(duration_us) / 1e6)));
  if (!faults.empty()) settings.push_back(setting("fault", fmt::format("[{}]", all)));
  return settings;
}

std::string check_of(std::string_view kind) { return fmt::format("{{ kind = \"{}\" }}", kind); }

}  // namespace

const Setting* FaultText::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &Setting::key);
  return found == keys.end() ? nullptr : &*found;
}

void FaultText::set(std::string_view key, std::string value) {
  const auto found = std::ranges::find(keys, key, &Setting::key);
  if (found != keys.end())
    found->value = std::move(value);
  else
    keys.push_back(setting(std::string(key), std::move(value)));
}

std::string FaultText::in_line() const {
  std::string text;
  for (const Setting& key : keys)
    text += fmt::format("{} {} = {}", text.empty() ? "{" : ",", key.key, key.value);
  return text + " }";
}

bool operator==(const FaultText& a, const FaultText& b) { return a.in_line() == b.in_line(); }

Result<scenario::Scenario> scenario_of(const Column& column, std::uint64_t run,
                                       const std::vector<FaultText>& faults, std::int64_t duration_us) {
  std::vector<std::string> checks;
  for (const std::string_view check : judged_by) checks.push_back(check_of(check));
  checks.insert(checks.end(), column.checks.begin(), column.checks.end());
  auto scenario = drive::parse_scenario(column.text, column.file,
                                        settings_of(column, run, faults, duration_us, checks), column.folder);
  if (scenario && faults.empty()) scenario->faults.clear();
  return scenario;
}

std::string text_of(const Column& column, std::uint64_t run, const std::vector<FaultText>& faults,
                    std::int64_t duration_us, const std::string& check, const std::string& comment) {
  // A violation that belongs to a check of every run, or that ended the flight, shows with any check.
  std::vector<std::string> checks = column.checks;
  const bool of_matrix = std::ranges::find(judged_by, check) != judged_by.end();
  if (of_matrix || checks.empty() || checks::is_implied(check) || check == flight_itself)
    checks = {check_of(of_matrix ? check : "answering")};
  std::vector<Setting> settings = settings_of(column, run, faults, duration_us, checks);
  if (faults.empty()) settings.push_back(setting("fault", ""));
  return comment + scenario::Section::edited_text(column.text, settings, column.folder);
}

}  // namespace canhil::campaign::matrix
