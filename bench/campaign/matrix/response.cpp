#include "bench/campaign/matrix/response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "bench/checks/kinds/honest.hpp"
#include "bench/drive/flight.hpp"
#include "bench/estimators/registry.hpp"

namespace canhil::campaign::matrix {
namespace {

using checks::CheckResult;
using checks::Outcome;
using checks::Sign;
using drive::Ending;
using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 5> names{"tolerated", "detected", "ended", "violated", "not measured"};

double seconds(std::int64_t t_us) { return static_cast<double>(t_us) * 1e-6; }

// The verdict on the flight up to its end, as if the flight had been planned to end there: a target that
// ended its estimation must have met the checks until then.
checks::Verdict verdict_to_its_end(const scenario::Scenario& scenario, const drive::Run& run) {
  if (run.ending.kind == Ending::Kind::completed) return run.verdict;
  return checks::judge(scenario, {.seen = run.seen,
                                  .truth = drive::truth_of(run.truth, run.per_run_truth, run.ending.t_us),
                                  .estimators = estimators::in(scenario),
                                  .timing_unfit = run.timing_unfit});
}

// Whether each estimator has answers that can be compared with the truth. An estimator may end before its
// first answer.
bool has_samples(const scenario::Scenario& scenario, const drive::Run& run) {
  return std::ranges::all_of(estimators::in(scenario), [&](const estimators::Estimator* one) {
    return !one->samples(run.seen, drive::truth_of(run.truth, run.per_run_truth, run.ending.t_us)).empty();
  });
}

// Removes the signs that also occur at the same times in the flight without faults.
std::vector<Sign> signs_beyond(std::vector<Sign> signs, const std::vector<Sign>& before) {
  for (Sign& sign : signs) {
    const auto same = std::ranges::find_if(
        before, [&](const Sign& other) { return other.name == sign.name && other.by == sign.by; });
    if (same == before.end()) continue;
    std::erase_if(sign.t_us, [&](std::int64_t t_us) { return std::ranges::binary_search(same->t_us, t_us); });
  }
  return signs;
}

// A sign that lasted from before the fault to its end: it hides what the target would report of the fault.
// Empty: there is none.
std::string hidden_by(const std::vector<Sign>& signs, std::int64_t onset_us, std::int64_t end_us,
                      std::int64_t duration_us) {
  for (const Sign& sign : signs) {
    if (checks::was_there_before(sign, onset_us) && checks::first_in({&sign, 1}, onset_us, end_us) &&
        (end_us >= duration_us || checks::last_after({&sign, 1}, end_us)))
      return sign.to_text();
  }
  return {};
}

std::int64_t latency_us(const scenario::Scenario& scenario) {
  std::int64_t longest = 0;
  for (const scenario::NodeSettings& node : scenario.nodes) longest = std::max(longest, node.latency_us());
  return longest;
}

// Extracts the heartbeat's error bits that ended the flight.
std::string reason_of(const std::string& detail) {
  constexpr std::string_view before = "its errors: ";
  const std::size_t at = detail.find(before);
  return at == std::string::npos ? detail : detail.substr(at + before.size());
}

// The checks of the matrix and those of every run are named by their kind, those of a campaign by their name.
const std::string& id_of(const CheckResult& check) {
  const bool of_bench = std::ranges::find(judged_by, check.kind) != judged_by.end();
  return of_bench || checks::is_implied(check.kind) ? check.kind : check.name;
}

Response violated(std::string_view check, std::string why) {
  return {.kind = Response::Kind::violated, .why = std::move(why), .check = std::string(check)};
}

}  // namespace

std::string_view name(Response::Kind kind) { return names[static_cast<std::size_t>(kind)]; }

Json json_of(const CellRun& run) {
  const Response& response = run.response;
  Json json{{"faults", run.faults}, {"response", name(response.kind)}};
  if (response.detected_s) json["detected_s"] = *response.detected_s;
  if (!response.by.empty()) json["by"] = response.by;
  if (response.recovered_s) json["recovered_s"] = *response.recovered_s;
  if (!response.why.empty()) json["why"] = response.why;
  if (!response.check.empty()) json["check"] = response.check;
  if (!run.replay.empty()) json["replay"] = run.replay;
  if (!run.target.empty()) json["target"] = run.target;
  if (!run.least.empty()) json["least"] = run.least;
  return json;
}

CellRun cell_run_in(const Json& json) {
  const auto kind = std::ranges::find(names, json.at("response").get<std::string>());
  if (kind == names.end()) throw Json::other_error::create(501, "unknown response", &json);
  CellRun run{.faults = json.at("faults"),
              .response = {.kind = static_cast<Response::Kind>(kind - names.begin())},
              .replay = json.value("replay", ""),
              .target = json.value("target", ""),
              .least = json.value("least", std::vector<std::string>())};
  Response& response = run.response;
  if (json.contains("detected_s")) response.detected_s = json["detected_s"].get<double>();
  if (json.contains("recovered_s")) response.recovered_s = json["recovered_s"].get<double>();
  response.by = json.value("by", "");
  response.why = json.value("why", "");
  response.check = json.value("check", "");
  return run;
}

std::string to_text(const Response& response) {
  switch (response.kind) {
    case Response::Kind::tolerated:
      return "tolerated";
    case Response::Kind::detected: {
      std::string text =
          fmt::format("detected in {:.3f} s ({})", response.detected_s.value_or(0), response.by);
      return text + (response.recovered_s ? fmt::format(", recovered in {:.3f} s", *response.recovered_s)
                                          : std::string(", not recovered"));
    }
    case Response::Kind::ended:
      return fmt::format("ended in {:.3f} s: {}", response.detected_s.value_or(0), response.why);
    case Response::Kind::violated:
      return fmt::format("violated {}: {}", response.check, response.why);
    case Response::Kind::not_measured:
      return fmt::format("not measured: {}", response.why);
  }
  return {};
}

Undisturbed undisturbed(const scenario::Scenario& scenario, const drive::Run& run) {
  Undisturbed found{.signs = checks::signs_in(run.seen, estimators::in(scenario))};
  for (const CheckResult& check : run.verdict.checks) {
    if (check.outcome != Outcome::pass) found.failed.push_back(id_of(check));
  }
  return found;
}

Response response_of(const scenario::Scenario& scenario, const drive::Run& run, const Undisturbed* before) {
  const bool ended = run.ending.kind == Ending::Kind::target_fault;
  if (run.ending.kind != Ending::Kind::completed && !ended) return violated(flight_itself, run.ending.detail);
  std::string unjudged;
  for (const CheckResult& check : verdict_to_its_end(scenario, run).checks) {
    if (ended && check.kind == checks::Honest::kind && !has_samples(scenario, run)) continue;
    if (before != nullptr && std::ranges::find(before->failed, id_of(check)) != before->failed.end())
      continue;
    if (check.outcome == Outcome::fail) return violated(id_of(check), check.measured);
    if (check.outcome == Outcome::not_measured && unjudged.empty())
      unjudged = fmt::format("{}: {}", id_of(check), check.measured);
  }
  if (!unjudged.empty()) return {.kind = Response::Kind::not_measured, .why = unjudged};
  if (scenario.faults.empty()) {
    if (ended) return violated(flight_itself, run.ending.detail);
    return {};
  }
  std::int64_t onset_us = std::numeric_limits<std::int64_t>::max(), end_us = 0;
  for (const faults::FaultReport& fault : run.faults) {
    for (const faults::Trigger& window : fault.windows) {
      onset_us = std::min(onset_us, window.from_us);
      end_us = std::max(end_us, window.to_us);
    }
  }
  if (ended)
    return {.kind = Response::Kind::ended,
            .detected_s = seconds(std::max<std::int64_t>(run.ending.t_us - onset_us, 0)),
            .why = reason_of(run.ending.detail)};
  for (const faults::FaultReport& fault : run.faults) {
    if (fault.count == 0)
      return {.kind = Response::Kind::not_measured, .why = fmt::format("'{}' did not strike", fault.name)};
  }
  const std::int64_t valid_from_us = std::max<std::int64_t>(onset_us - latency_us(scenario), 0);
  const std::vector<Sign> all = checks::signs_in(run.seen, estimators::in(scenario));
  const std::vector<Sign> signs = checks::new_since(
      signs_beyond(all, before == nullptr ? std::vector<Sign>() : before->signs), valid_from_us);
  const auto first = checks::first_in(signs, valid_from_us, scenario.duration_us);
  if (!first) {
    const std::string hidden = hidden_by(all, valid_from_us, end_us, scenario.duration_us);
    if (hidden.empty()) return {};
    return {.kind = Response::Kind::not_measured, .why = fmt::format("{} without the fault too", hidden)};
  }
  Response response{.kind = Response::Kind::detected,
                    .detected_s = seconds(std::max<std::int64_t>(first->t_us - onset_us, 0)),
                    .by = first->text};
  const auto last = checks::last_after(signs, end_us);
  constexpr std::int64_t quiet_us = 1'000'000;  // if no sign follows for this long, the target has recovered
  if (!last)
    response.recovered_s = 0;
  else if (last->t_us + quiet_us <= scenario.duration_us)
    response.recovered_s = seconds(last->t_us - end_us);
  return response;
}

}  // namespace canhil::campaign::matrix
