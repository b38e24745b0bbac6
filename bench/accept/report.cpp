#include "bench/accept/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/checks/result_json.hpp"
#include "bench/report/page_parts.hpp"
#include "bench/report/run_reports.hpp"
#include "dbc/text/escape.hpp"

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

/// All items as an HTML list, collapsed by default.
std::string all_of(const Finding& finding) {
  std::string list;
  for (const Item& item : finding.items)
    list += fmt::format("<li>{} {}: {}; expected {}</li>", report::look_of(checks::name(item.outcome)).sign,
                        escaped(item.name), escaped(item.measured), escaped(item.expected));
  return report::folded(fmt::format("{} looked at", finding.items.size()), fmt::format("<ul>{}</ul>", list));
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
           report::table({"requirement", "what is asked", "outcome", "seen"}, rows);
  }
  return report::section(suite.estimator, suite.title, out);
}

// The question that the report answers.
std::string asked(const Report& report) {
  return report.same_as.empty()
             ? "asked: is it good (--same-as hil-target also compares the answers)"
             : fmt::format("asked: is it good, and does it answer as {} does", report.same_as);
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
        out += fmt::format("  {:<12}  {:<12} {}  ({} looked at)\n", report::label(word(finding)),
                           finding.requirement.id, finding.requirement.text, finding.items.size());
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
  return report::whole_page(fmt::format("{}: acceptance", verdict), report::styles, body);
}

}  // namespace canhil::accept
