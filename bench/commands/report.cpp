#include "bench/commands/report.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/report/compare.hpp"
#include "bench/report/file.hpp"
#include "bench/report/page.hpp"

namespace canhil::commands {
namespace {

// A report's page stands beside it.
std::string page_path(const std::string& report) {
  return std::filesystem::path(report).replace_extension(".html").string();
}

Result<void> rebuild(const std::string& path) {
  auto document = report::read_document(path);
  if (!document) return tl::unexpected(document.error());
  auto page = report::html(*document);
  if (!page) return failure(fmt::format("file '{}': {}", path, page.error().message));
  return report::write_file(page_path(path), *page);
}

ExitCode rebuild_all(const std::vector<std::string>& paths) {
  std::vector<std::string> all = paths;
  for (const std::string& path : paths) all.push_back(page_path(path));
  if (auto distinct = report::check_distinct(all); !distinct) return complain(distinct.error());
  for (const std::string& path : paths) {
    if (auto built = rebuild(path); !built) return complain(built.error());
    fmt::print("{}\n", page_path(path));
  }
  return ExitCode::pass;
}

ExitCode compare_both(const std::string& before, const std::string& after) {
  const auto a = report::read_document(before);
  if (!a) return complain(a.error());
  const auto b = report::read_document(after);
  if (!b) return complain(b.error());
  const auto compared = report::compare(*a, *b);
  if (!compared) return complain(compared.error());
  if (auto shown = report::write_stdout(compared->text); !shown) return complain(shown.error());
  switch (compared->outcome) {
    case report::Comparison::no_worse:
      return ExitCode::pass;
    case report::Comparison::worse:
      return ExitCode::fail;
    case report::Comparison::not_comparable:
      break;
  }
  return ExitCode::not_measured;
}

}  // namespace

void add_report(command_line::Command app, int& code) {
  auto paths = std::make_shared<std::vector<std::string>>();
  const auto rebuild = app.add_subcommand("report", "make the HTML pages of reports again from their JSON");
  rebuild.add_option("FILE.json", *paths, "reports of hil-bench run --json; FILE.html is written beside each")
      .required();
  rebuild.on_given([&code, paths] { code = static_cast<int>(rebuild_all(*paths)); });

  auto before = std::make_shared<std::string>();
  auto after = std::make_shared<std::string>();
  const auto compare = app.add_subcommand(
      "compare",
      "say what got worse from one run to another of the same scenario: 0 nothing, 1 something, 3 not "
      "comparable");
  compare.add_option("A.json", *before, "the report to compare with").required();
  compare.add_option("B.json", *after, "the report that is judged").required();
  compare.on_given([&code, before, after] { code = static_cast<int>(compare_both(*before, *after)); });
}

}  // namespace canhil::commands
