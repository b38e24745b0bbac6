#include "bench/scenario/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "bench/scenario/quantity.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::scenario {
namespace {

using Endings = std::array<std::string_view, 4>;
constexpr std::array<Endings, 8> of_one_dimension{{{"_s", "_ms", "_us"},
                                                   {"_deg", "_rad", "_mrad"},
                                                   {"_degps", "_radps", "_mradps", "_degph"},
                                                   {"_mps", "_kmph"},
                                                   {"_mps2", "_g", "_ug"},
                                                   {"_m"},
                                                   {"_pa", "_hpa"},
                                                   {"_t", "_ut"}}};

/// The names under which a column may appear: `name`, then `name` with each other unit of the same quantity
/// as suffix.
std::vector<std::string> names_of(std::string_view name) {
  std::vector<std::string> names{std::string(name)};
  for (const Endings& endings : of_one_dimension) {
    const auto own = std::ranges::find_if(
        endings, [&](std::string_view ending) { return !ending.empty() && name.ends_with(ending); });
    if (own == endings.end()) continue;
    const std::string_view stem = name.substr(0, name.size() - own->size());
    for (const std::string_view ending : endings) {
      if (!ending.empty() && ending != *own) names.push_back(fmt::format("{}{}", stem, ending));
    }
  }
  return names;
}

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// Returns the text before the next separator, or the whole rest, and removes this text and the separator
/// from `rest`.
std::string_view take(std::string_view& rest, char separator) {
  const std::size_t end = rest.find(separator);
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return part;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (bool more = true; more;) {
    more = line.find(',') != std::string_view::npos;
    fields.push_back(trimmed(take(line, ',')));
  }
  return fields;
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stopped != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// A user's text for a message of one line: at most 40 characters, escaped.
std::string shown(std::string_view text) {
  constexpr std::size_t most = 40;
  return one_line(text.substr(0, most)) + (text.size() > most ? "..." : "");
}

/// The column with a requested name: its index in the file, and the factor from its unit to the requested
/// unit.
struct Column {
  std::size_t index = 0;
  double factor = 1;
};

Result<std::optional<Column>> find(std::string_view name, std::span<const std::string_view> header,
                                   std::string_view file) {
  std::optional<Column> column;
  for (const std::string& candidate : names_of(name)) {
    for (std::size_t index = 0; index < header.size(); ++index) {
      if (header[index] != candidate) continue;
      if (column)
        return failure(fmt::format("{}:1: column '{}': is given beside '{}', expected one of the two", file,
                                   candidate, header[column->index]));
      column = Column{.index = index, .factor = factor_of(candidate) / factor_of(name)};
    }
  }
  return column;
}

}  // namespace

Error Table::about(std::size_t row, std::size_t index, std::string_view what) const {
  return {fmt::format("{}:{}: column '{}': {}", file, lines[row], found[index], what)};
}

Error Table::missing(std::size_t index) const {
  const std::vector<std::string> names = names_of(asked[index]);
  const std::string others =
      names.size() > 1 ? fmt::format(" or '{}'", fmt::join(names.begin() + 1, names.end(), "', '")) : "";
  return {fmt::format("{}:1: column '{}': is missing, expected it{}", file, asked[index], others)};
}

Result<Table> read_table(std::string_view text, std::string_view file, std::span<const std::string> names) {
  Table table{.file = std::string(file),
              .asked = {names.begin(), names.end()},
              .found = {},
              .values = {},
              .lines = {}};
  if (text.starts_with("\xEF\xBB\xBF"))
    text.remove_prefix(3);  // a byte order mark, as some spreadsheets write it
  const std::vector<std::string_view> header = fields_of(take(text, '\n'));
  std::vector<std::optional<Column>> columns;
  for (const std::string& name : names) {
    const auto column = find(name, header, file);
    if (!column) return tl::unexpected(column.error());
    columns.push_back(*column);
    table.found.emplace_back(*column ? header[(*column)->index] : "");
  }
  for (std::size_t line = 2; !text.empty(); ++line) {
    const std::string_view row = trimmed(take(text, '\n'));
    if (row.empty() && trimmed(text).empty()) break;  // the last line may end with a line break
    const std::vector<std::string_view> fields = fields_of(row);
    if (fields.size() != header.size())
      return failure(fmt::format("{}:{}: has {} values, expected {}, one for each column", file, line,
                                 row.empty() ? 0 : fields.size(), header.size()));
    table.lines.push_back(line);
    for (std::size_t index = 0; index < columns.size(); ++index) {
      const auto& column = columns[index];
      const auto value = column ? number(fields[column->index]) : std::optional(0.0);
      if (!value)
        return tl::unexpected(
            table.about(table.rows() - 1, index,
                        fmt::format("'{}' is not a number, expected one", shown(fields[column->index]))));
      table.values.push_back(column ? *value * column->factor : 0);
    }
  }
  if (table.rows() == 0) return failure(fmt::format("{}: has no rows, expected some", file));
  return table;
}

Result<std::vector<std::int64_t>> times_of(const Table& table, std::size_t index, std::int64_t from_us) {
  constexpr double most_s = 1e11;  // in microseconds it fits easily into 64 bits
  std::vector<std::int64_t> t_us;
  t_us.reserve(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t_s = table.value(row, index);
    if (std::abs(t_s) > most_s)
      return tl::unexpected(table.about(row, index, fmt::format("{:g} s is not a time, expected one", t_s)));
    t_us.push_back(std::llround(t_s * 1e6) - from_us);
    if (row > 0 && t_us[row] <= t_us[row - 1])
      return tl::unexpected(table.about(row, index,
                                        fmt::format("{} s does not come after {} s, the time of the row "
                                                    "before, expected times that ascend by at least 1 us",
                                                    t_s, table.value(row - 1, index))));
  }
  return t_us;
}

Result<Rows> covering(const Table& table, std::size_t index, std::span<const std::int64_t> t_us,
                      std::int64_t end_us, std::int64_t gap_us) {
  const auto seconds = [](std::int64_t us) { return 1e-6 * static_cast<double>(us); };
  if (t_us.front() > 0)
    return tl::unexpected(table.about(
        0, index,
        fmt::format("the first row comes {:g} s after the time that 'from_s' says, expected a row "
                    "at or before it",
                    seconds(t_us.front()))));
  if (t_us.back() < end_us)
    return tl::unexpected(
        table.about(table.rows() - 1, index,
                    fmt::format("the last row is at {:g} s of the run, expected rows to its end at {:g} s",
                                seconds(t_us.back()), seconds(end_us))));
  const auto after = std::ranges::upper_bound(t_us, 0);
  const auto end = std::ranges::lower_bound(t_us, end_us);
  const Rows rows{.first = static_cast<std::size_t>(after - t_us.begin()) - 1,
                  .last = static_cast<std::size_t>(end - t_us.begin())};
  for (std::size_t row = rows.first + 1; row <= rows.last; ++row) {
    const std::int64_t step_us = t_us[row] - t_us[row - 1];
    if (step_us > gap_us)
      return tl::unexpected(
          table.about(row, index,
                      fmt::format("comes {:g} s after the row before, expected at most {:g} s (key 'gap_s')",
                                  seconds(step_us), seconds(gap_us))));
  }
  return rows;
}

std::int64_t median_step(std::span<const std::int64_t> ascending) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < ascending.size(); ++i) steps.push_back(ascending[i] - ascending[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  return *middle;
}

}  // namespace canhil::scenario
