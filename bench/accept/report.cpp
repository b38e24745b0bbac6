#include "bench/accept/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/checks/result_json.hpp"
#include "bench/report/page_parts.hpp"
#include "bench/report/provenance.hpp"
#include "bench/report/run_reports.hpp"
#include "dbc/text/escape.hpp"
#include "dbc/version/version.hpp"

namespace canhil::accept {
namespace {

using checks::Outcome;
using nlohmann::ordered_json;
using report::escaped;

std::size_t count(const Acceptance& suite, std::string_view outcome) {
  return static_cast<std::size_t>(std::ranges::count(suite.findings, outcome, word));
}

std::string counts(const Acceptance& suite) {
  std::string words = fmt::format("{} of {} requirements met", count(suite, "pass"), suite.findings.size());
  if (const auto failed = count(suite, "fail"); failed > 0) words += fmt::format(", {} not met", failed);
  for (const std::string_view open : {"not measured", "not reached"}) {
    if (count(suite, open) > 0) words += fmt::format(", {} {}", count(suite, open), open);
  }
  return words;
}

/// The items shown by default: those that did not pass, failures first.
std::vector<const Item*> shown_items(const Finding& finding) {
  std::vector<const Item*> items;
  for (const Item& item : finding.items) {
    if (item.outcome != Outcome::pass) items.push_back(&item);
  }
  std::ranges::stable_sort(items, {}, [](const Item* item) { return item->outcome != Outcome::fail; });
  return items;
}

constexpr std::size_t most_shown = 5;

std::string percent(const std::optional<double>& margin) {
  return margin ? fmt::format("{:.0f} %", 100 * *margin) : "";
}

std::string tests(std::size_t count) { return fmt::format("{} test{}", count, count == 1 ? "" : "s"); }

/// The margin of an item; none: it has no numbers, or must have exactly one value.
std::optional<double> margin_of(const Item& item) {
  const auto& [criterion, measurement] = item.judgement;
  const bool exact = criterion.lower && criterion.upper && criterion.lower->value == criterion.upper->value;
  return exact ? std::nullopt : checks::margin(item.judgement);
}

/// The item that is nearest to its limit; null: no item has numbers.
const Item* nearest(const Finding& finding) {
  const Item* found = nullptr;
  for (const Item& item : finding.items) {
    const auto margin = margin_of(item);
    if (margin && (found == nullptr || *margin < *margin_of(*found))) found = &item;
  }
  return found;
}

/// "37 tests, the smallest margin 12 %".
std::string extent(const Finding& finding) {
  const Item* least = nearest(finding);
  return tests(finding.items.size()) +
         (least == nullptr ? "" : fmt::format(", the smallest margin {}", percent(margin_of(*least))));
}

/// All items as an HTML table, collapsed by default.
std::string all_of(const Finding& finding) {
  report::Rows rows;
  for (const Item& item : finding.items)
    rows.push_back({escaped(item.name), report::outcome_words(checks::name(item.outcome)),
                    escaped(item.measured), escaped(item.expected), percent(margin_of(item))});
  return report::folded(extent(finding),
                        report::table({"test", "outcome", "measured", "expected", "margin"}, rows));
}

std::string section(const Acceptance& suite) {
  std::string out = fmt::format("<p class=\"sub\">{} &middot; {} in {:.0f} s</p>\n", escaped(suite.estimator),
                                counts(suite), suite.wall_s);
  for (const std::string& family : families) {
    report::Rows rows;
    for (const Finding& finding : suite.findings) {
      if (finding.requirement.family != family) continue;
      std::string seen = all_of(finding);
      const auto wrong = shown_items(finding);
      for (std::size_t i = 0; i < std::min(wrong.size(), most_shown); ++i)
        seen += fmt::format("<p><b>{}</b>: {}; expected {}</p>", escaped(wrong[i]->name),
                            escaped(wrong[i]->measured), escaped(wrong[i]->expected));
      if (wrong.size() > most_shown) seen += fmt::format("<p>and {} more</p>", wrong.size() - most_shown);
      rows.push_back({escaped(finding.requirement.id), escaped(finding.requirement.text),
                      report::outcome_words(checks::name(finding.outcome()), word(finding)), seen});
    }
    if (rows.empty()) continue;
    out += fmt::format("<h3>{}</h3>\n", family) +
           report::table({"requirement", "what is asked", "outcome", "evidence"}, rows);
  }
  return report::section(suite.estimator, suite.title, out);
}

// The question that the report answers.
std::string asked(const Report& report) {
  return report.same_as.empty()
             ? "The question: is the target good? (--same-as hil-target also compares its answers)"
             : fmt::format("The question: is the target good, and are its answers those of {}?{}",
                           report.same_as,
                           report.tolerance > 1
                               ? fmt::format(" The tolerances were multiplied by {:g}.", report.tolerance)
                               : "");
}

// What the report is about: the options of the command, the programs and the files.
ordered_json options_of(const Report& report) {
  ordered_json options{{"families", report.families.empty() ? families : report.families}};
  if (!report.same_as.empty()) options["tolerance"] = report.tolerance;
  if (report.seed) options["seed"] = *report.seed;
  return options;
}

ordered_json provenance_of(const Report& report) {
  ordered_json files = ordered_json::array();
  for (const drive::RunFile& file : report.files)
    files.push_back({{"role", file.role}, {"name", file.name}, {"sha256", file.identity.sha256}});
  return {{"date", report::date_utc(report.started_s)},
          {"version", version_text()},
          {"revision", revision()},
          {"host", report::host_name()},
          {"kernel", report::kernel()},
          {"cpu_model", report::cpu_model()},
          {"files", std::move(files)}};
}

std::string provenance_section(const Report& report) {
  ordered_json facts{{"target", report.target}};
  facts["families"] =
      fmt::format("{}", fmt::join(report.families.empty() ? families : report.families, ", "));
  ordered_json known = provenance_of(report);
  const ordered_json options = options_of(report);
  for (const auto& [key, value] : options.items()) {
    if (key != "families") facts[key] = value;
  }
  const ordered_json files = known["files"];
  known.erase("files");
  facts.update(known);
  report::Rows rows;
  for (const ordered_json& file : files)
    rows.push_back(
        {report::text_in(file["role"]), report::text_in(file["name"]), report::text_in(file["sha256"])});
  return report::section(
      "provenance", "Provenance",
      report::facts(facts) + report::folded(fmt::format("{} files", files.size()),
                                            report::table({"role", "file", "SHA-256"}, rows)));
}

}  // namespace

Outcome Report::outcome() const { return checks::outcome_of(suites, &Acceptance::outcome); }

std::string text(const Report& report) {
  std::string out;
  for (const Acceptance& suite : report.suites) {
    out += one_line(suite.title) + "\n\n";
    for (const std::string& family : families) {
      for (const Finding& finding : suite.findings) {
        if (finding.requirement.family != family) continue;
        out += fmt::format("  {:<12}  {:<14} {}  ({})\n", report::label(word(finding)),
                           finding.requirement.id, finding.requirement.text, extent(finding));
        const auto wrong = shown_items(finding);
        for (std::size_t i = 0; i < std::min(wrong.size(), most_shown); ++i)
          out += fmt::format("      {} {}: {}; expected {}\n", wrong[i]->outcome == Outcome::fail ? "-" : "?",
                             wrong[i]->name, wrong[i]->measured, wrong[i]->expected);
        if (wrong.size() > most_shown) out += fmt::format("      and {} more\n", wrong.size() - most_shown);
      }
    }
    out += fmt::format("\n{}: {}: {} ({:.0f} s)\n\n", suite.estimator, checks::name(suite.outcome()),
                       counts(suite), suite.wall_s);
  }
  return out + fmt::format("{}\n{}: {}\n", asked(report), report.target, checks::name(report.outcome()));
}

std::string json(const Report& report) {
  ordered_json suites = ordered_json::array();
  for (const Acceptance& suite : report.suites) {
    ordered_json requirements = ordered_json::array();
    for (const Finding& finding : suite.findings) {
      ordered_json items = ordered_json::array();
      for (const Item& item : finding.items) {
        ordered_json entry = checks::json_of(item);
        entry.erase("requirement");  // it is that of the list
        items.push_back(std::move(entry));
      }
      requirements.push_back({{"id", finding.requirement.id},
                              {"family", finding.requirement.family},
                              {"text", finding.requirement.text},
                              {"outcome", word(finding)},
                              {"items", std::move(items)}});
    }
    suites.push_back({{"estimator", suite.estimator},
                      {"title", suite.title},
                      {"outcome", checks::name(suite.outcome())},
                      {"wall_s", suite.wall_s},
                      {"requirements", std::move(requirements)}});
  }
  const ordered_json all{{"schema", "canhil-acceptance-1"},
                         {"target", report.target},
                         {"same_as", report.same_as},
                         {"options", options_of(report)},
                         {"provenance", provenance_of(report)},
                         {"started_s", report.started_s},
                         {"outcome", checks::name(report.outcome())},
                         {"suites", std::move(suites)}};
  return all.dump(1) + "\n";
}

std::string junit(const Report& report) {
  std::string suites;
  for (const Acceptance& suite : report.suites) {
    std::vector<checks::CheckResult> cases;
    for (const Finding& finding : suite.findings) {
      for (const Item& item : finding.items) {
        cases.push_back(item);
        cases.back().kind = finding.requirement.family;  // the class of a test case
      }
    }
    suites += report::junit_suite(suite.title, fmt::format("accept.{}", suite.estimator), cases, suite.wall_s,
                                  report.started_s);
  }
  return report::junit_whole(suites);
}

std::string page(const Report& report) {
  const std::string_view verdict = checks::name(report.outcome());
  std::string body =
      report::head("Acceptance", escaped(report.target)) + report::verdict(verdict, asked(report));
  report::Rows rows;
  for (const Acceptance& suite : report.suites)
    rows.push_back(
        {escaped(suite.estimator), report::outcome_words(checks::name(suite.outcome())), counts(suite)});
  body += report::table({"estimator", "outcome", "requirements"}, rows);
  for (const Acceptance& suite : report.suites) body += section(suite);
  body += provenance_section(report);
  return report::whole_page(fmt::format("{}: acceptance", verdict), report::styles, body);
}

}  // namespace canhil::accept
