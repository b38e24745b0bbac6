#include "bench/report/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/checks/probability.hpp"
#include "bench/checks/result_json.hpp"
#include "bench/report/page_parts.hpp"
#include "bench/report/plot.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::report {
namespace {

using checks::Outcome;

// A check in the runs of a scenario, by the number of the run; none: the run has no such check.
struct Course {
  std::string name;
  std::vector<std::optional<checks::CheckResult>> in_runs;
};

struct Line {
  std::string name, outcome, words;  // "0.98 -> 1.45 mrad/s, limit < 2.3 mrad/s; margin 57.2 % -> 36.9 %"
  bool worse = false;
};

std::string scenario_of(const Json& report) {
  return report.at("provenance").at("scenario").get<std::string>();
}
std::string date_of(const Json& report) { return report.at("provenance").at("date").get<std::string>(); }

std::vector<Course> courses_of(const std::vector<const Kept*>& runs) {
  std::vector<Course> courses;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    for (const Json& check : runs[run]->report.at("checks")) {
      checks::CheckResult result = checks::result_in(check);
      auto known = std::ranges::find(courses, result.name, &Course::name);
      if (known == courses.end()) known = courses.insert(known, {.name = result.name, .in_runs = {}});
      known->in_runs.resize(runs.size());
      known->in_runs[run] = std::move(result);
    }
  }
  for (Course& course : courses) course.in_runs.resize(runs.size());
  return courses;
}

std::optional<double> margin_in(const std::optional<checks::CheckResult>& result) {
  return result ? checks::margin(result->judgement) : std::nullopt;
}

std::string outcome_in(const std::optional<checks::CheckResult>& result) {
  return result ? std::string(checks::name(result->outcome)) : "not there";
}

Line line_of(const Course& course, double tolerance) {
  const auto& newest = course.in_runs.back();
  Line line{.name = course.name, .outcome = outcome_in(newest), .words = {}};
  std::vector<double> before;
  const std::optional<checks::CheckResult>* first = nullptr;
  for (std::size_t run = 0; run + 1 < course.in_runs.size(); ++run) {
    if (first == nullptr && course.in_runs[run]) first = &course.in_runs[run];
    if (const auto margin = margin_in(course.in_runs[run])) before.push_back(*margin);
  }
  const auto failed = [](const auto& result) { return result && result->outcome == Outcome::fail; };
  line.worse = failed(newest);
  const auto value = newest ? newest->judgement.measurement.value : std::nullopt;
  if (value) {
    std::optional<double> earlier;
    if (first != nullptr) earlier = (*first)->judgement.measurement.value;
    const std::string& unit = newest->judgement.criterion.unit;
    line.words = fmt::format("{}{:.4g}{}{}, limit {}", earlier ? fmt::format("{:.4g} -> ", *earlier) : "",
                             *value, unit.empty() ? "" : " ", unit, to_text(newest->judgement.criterion));
  }
  if (const auto margin = margin_in(newest); margin && !before.empty()) {
    const double usual = checks::median(before);
    line.words += fmt::format(
        "; margin {:.1f} %, before {:.1f} % (median of {}, {:.1f} to {:.1f} %)", 100 * *margin, 100 * usual,
        before.size(), 100 * *std::ranges::min_element(before), 100 * *std::ranges::max_element(before));
    line.worse = line.worse || usual - *margin > tolerance;
  }
  const auto fails = std::ranges::count_if(course.in_runs, failed);
  if (fails > 0) line.words += fmt::format("; failed in {} of {} runs", fails, course.in_runs.size());
  return line;
}

// The margins over the runs: a curve for each check.
std::string picture_of(const std::vector<Course>& courses) {
  LinePlot plot;
  plot.title = "margins of the checks";
  plot.unit = "%";
  plot.t_unit = "run";
  plot.begins_at_first = true;
  plot.levels = {0};
  plot.levels_name = "limit";
  for (std::size_t run = 0; run < courses.front().in_runs.size(); ++run)
    plot.t_s.push_back(static_cast<double>(run + 1));
  for (const Course& course : courses) {
    std::vector<double> margins;
    for (const auto& result : course.in_runs)
      margins.push_back(100 * margin_in(result).value_or(std::numeric_limits<double>::quiet_NaN()));
    if (std::ranges::any_of(margins, [](double one) { return std::isfinite(one); }))
      plot.lines.push_back({.name = course.name, .values = std::move(margins)});
  }
  return plot.lines.empty() ? ""
                            : grid(figure(plot.title, drawn(plot), "In the order of the dates of the runs."));
}

// One scenario: its lines of text and its section of the page.
void tell(const std::string& scenario, std::size_t number, const std::vector<const Kept*>& runs,
          double tolerance, History& out, std::string& sections) {
  const std::string head = fmt::format("{}: {} runs, {} to {}", scenario, runs.size(),
                                       date_of(runs.front()->report), date_of(runs.back()->report));
  out.text += one_line(head) + "\n";
  const std::vector<Course> courses = courses_of(runs);
  std::vector<Judged> rows;
  bool worse = false;
  for (const Course& course : courses) {
    const Line line = line_of(course, tolerance);
    worse = worse || line.worse;
    out.text += one_line(fmt::format("  {}  {}: {}{}{}", line.worse ? "worse" : "same ", line.name,
                                     line.outcome, line.words.empty() ? "" : "; ", line.words)) +
                "\n";
    rows.push_back({.name = line.name,
                    .outcome = line.worse ? "fail" : line.outcome,
                    .measured = line.words,
                    .expected = {},
                    .requirement = {}});
  }
  if (runs.size() < 2) {
    out.text += "  one run shows no history\n";
    return;
  }
  if (out.outcome != Outcome::fail) out.outcome = worse ? Outcome::fail : Outcome::pass;
  sections += section(fmt::format("scenario-{}", number), head, picture_of(courses) + judgements(rows));
}

}  // namespace

Result<History> history(std::vector<Kept> reports, double tolerance) {
  History out;
  std::string sections;
  std::map<std::string, std::vector<const Kept*>> by_scenario;
  for (const Kept& one : reports) {
    try {
      static_cast<void>(date_of(one.report));
      by_scenario[scenario_of(one.report)].push_back(&one);
    } catch (const Json::exception& error) {
      return failure(fmt::format("file '{}': {}", one.file, error.what()));
    }
  }
  std::size_t number = 0;
  for (auto& [scenario, runs] : by_scenario) {
    std::ranges::stable_sort(runs, {}, [](const Kept* one) { return date_of(one->report); });
    try {
      tell(scenario, ++number, runs, tolerance, out, sections);
    } catch (const Json::exception& error) {
      return failure(fmt::format("scenario '{}': {}", scenario, error.what()));
    }
  }
  const std::string_view verdict = out.outcome == Outcome::pass   ? "nothing got worse"
                                   : out.outcome == Outcome::fail ? "something got worse, or fails"
                                                                  : "no scenario has two runs";
  out.text += fmt::format("{}: {}\n", checks::name(out.outcome), verdict);
  out.page =
      whole_page("History", styles,
                 head("History", fmt::format("{} runs of {} scenarios", reports.size(), by_scenario.size())) +
                     report::verdict(checks::name(out.outcome), verdict) + sections,
                 scripts);
  return out;
}

}  // namespace canhil::report
