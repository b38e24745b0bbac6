#include <fmt/format.h>

#include "dbc/logs/csv.hpp"
#include "dbc/logs/line_source.hpp"
#include "dbc/logs/words.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::logs {
namespace {

constexpr std::int64_t ns_per_us = 1000;

void split_cells(std::string_view text, std::vector<std::string_view>& cells) {
  cells.clear();
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    std::string_view cell = text.substr(at, end - at);
    while (cell.starts_with(' ')) cell.remove_prefix(1);
    while (cell.ends_with(' ')) cell.remove_suffix(1);
    cells.push_back(cell);
    at = end + 1;
  }
}

}  // namespace

Result<Parsed> CsvParser::header() {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found =
        std::ranges::find_if(cells_, [&](std::string_view cell) { return same(cell, names[i]); });
    if (found != cells_.end())
      places_[i] = static_cast<std::size_t>(found - cells_.begin());
    else if (i != direction)
      return failure(fmt::format("a column '{}' in the header", names[i]));
  }
  has_header_ = true;
  return Parsed{};
}

std::string_view CsvParser::cell(Column column) const {
  const auto& place = places_.at(column);
  return place && *place < cells_.size() ? cells_[*place] : std::string_view{};
}

Result<Parsed> CsvParser::line(std::string_view text) {
  split_cells(text, cells_);
  if (cells_.size() == 1 && cells_[0].empty()) return Parsed{};
  if (!has_header_) return header();
  LogEntry entry;
  Frame& frame = entry.frame;
  const auto t_ns = time_of(cell(time), ns_per_us);
  if (!t_ns) return failure("the time in microseconds");
  entry.t_ns = *t_ns;
  const auto id_value = number_of<std::uint32_t>(cell(id), 16);
  frame.extended = same(cell(extended), "true") || cell(extended) == "1";
  if (!id_value || *id_value > (frame.extended ? max_extended_id : max_standard_id)) return failure("an id");
  frame.id = *id_value;
  entry.transmitted = same(cell(direction), "tx");
  const auto bus_number = number_of<unsigned>(cell(bus));
  if (!bus_number) return failure("the number of the bus");
  entry.interface = fmt::format("can{}", *bus_number);
  const auto size = number_of<std::uint8_t>(cell(length));
  frame.fd = size && *size > 8;  // the format does not distinguish shorter frames of CAN FD
  if (!size || *size > Frame::max_size || !size_has_dlc(*size, true))
    return failure("0-8, 12, 16, 20, 24, 32, 48 or 64 bytes");
  frame.size = *size;
  const std::size_t first = places_[data].value_or(0);
  if (cells_.size() < first + frame.size) return failure(fmt::format("{} bytes of data", frame.size));
  for (std::size_t i = 0; i < frame.size; ++i) {
    const auto byte = number_of<std::uint8_t>(cells_[first + i], 16);
    if (!byte) return failure(fmt::format("a byte in place of '{}'", cells_[first + i]));
    frame.data[i] = *byte;
  }
  return Parsed{.entry = std::move(entry)};
}

std::unique_ptr<LogSource> csv_source(Input input) {
  return std::make_unique<LineSource<CsvParser>>(std::move(input));
}

}  // namespace canhil::logs
