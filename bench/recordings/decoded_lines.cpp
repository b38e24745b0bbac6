#include "bench/recordings/decoded_lines.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "dbc/spool/spool.hpp"
#include "dbc/text/escape.hpp"
#include "dbc/wire/j1939.hpp"

namespace canhil::recordings {
namespace {

const dbc::Signal& signal_of(const DecodedFrame& frame, const SignalValue& value) {
  return frame.message.signals[value.index];
}

class Text final : public LineWriter {
 public:
  explicit Text(const Sink& give) : give_(give) {}
  void write(const DecodedFrame& frame) override {
    std::string text =
        fmt::format("{:>12}  {} {}", frame.t_s, frame.entry.interface, frame.entry.transmitted ? "T" : "R");
    if (frame.is_group) text += addresses(frame.entry.frame.id);
    text += fmt::format(" {}:", frame.message.name);
    for (const SignalValue& value : frame.values) {
      const dbc::Signal& signal = signal_of(frame, value);
      text += fmt::format(" {}={}", signal.name, value.text.empty() ? "missing" : value.text);
      if (value.text.empty()) continue;
      if (!signal.unit.empty()) text += " " + signal.unit;
      if (!value.name.empty()) text += fmt::format(" ({})", value.name);
    }
    give_(one_line(text) + "\n");
  }

 private:
  static std::string addresses(std::uint32_t id) {
    const auto destination = wire::j1939_destination(id);
    return fmt::format(" from {}{}", wire::j1939_source(id),
                       destination ? fmt::format(" to {}", *destination) : "");
  }
  const Sink& give_;
};

// The columns are known only after the last frame. Therefore the rows are kept until then. The log cannot be
// read twice, because it may come from a pipe.
class Csv final : public LineWriter {
 public:
  Csv(const dbc::Database& database, bool with_groups, const Sink& give)
      : database_(database), with_groups_(with_groups), give_(give) {}

  void write(const DecodedFrame& frame) override {
    Row row{.message = static_cast<std::size_t>(&frame.message - database_.messages.data())};
    std::string text = fmt::format("{},{}", frame.t_s, for_csv(frame.entry.interface));
    if (with_groups_) text += frame.is_group ? addresses(frame.entry.frame.id) : ",,";
    row.head = text.size();
    std::size_t column = 0;
    for (const SignalValue& value : frame.values) {
      text.append(value.index - column, ',');
      column = value.index;
      text += value.text;
    }
    if (!frame.message.signals.empty()) text.append(frame.message.signals.size() - 1 - column, ',');
    row.size = text.size();
    for (const char c : text) text_.push_back(c);
    rows_.push_back(row);
    columns_.emplace(row.message, 0);
  }

  void finish() override {
    std::string head = with_groups_ ? "t_s,bus,source,destination" : "t_s,bus";
    std::size_t columns = 0;
    for (auto& [message, first] : columns_) {
      first = columns;
      columns += database_.messages[message].signals.size();
      for (const dbc::Signal& signal : database_.messages[message].signals)
        head += "," + for_csv(database_.messages[message].name + "." + signal.name);
    }
    give_(head + "\n");
    auto next = text_.begin();
    std::string line;
    for (const Row& row : rows_) {
      line.assign(next, next + static_cast<std::ptrdiff_t>(row.head));
      const std::size_t own = database_.messages[row.message].signals.size(), before = columns_[row.message];
      line.append(before, ',');
      if (own > 0) line += ',';
      line.append(next + static_cast<std::ptrdiff_t>(row.head), next + static_cast<std::ptrdiff_t>(row.size));
      line.append(columns - before - own, ',');
      line += '\n';
      give_(line);
      next += static_cast<std::ptrdiff_t>(row.size);
    }
  }

 private:
  struct Row {
    std::size_t message = 0;         // index in the database
    std::size_t head = 0, size = 0;  // number of characters before the first signal, and of all characters
  };
  static std::string addresses(std::uint32_t id) {
    const auto destination = wire::j1939_destination(id);
    return fmt::format(",{},{}", wire::j1939_source(id), destination ? fmt::to_string(*destination) : "");
  }

  const dbc::Database& database_;
  bool with_groups_;
  const Sink& give_;
  Spool<char> text_;
  Spool<Row> rows_;
  std::map<std::size_t, std::size_t> columns_;  // index of a message that occurs -> its first column
};

class JsonLines final : public LineWriter {
 public:
  explicit JsonLines(const Sink& give) : give_(give) {}
  void write(const DecodedFrame& frame) override {
    const LogEntry& entry = frame.entry;
    // Numbers are inserted as text: a double cannot represent nanoseconds since 1970 or all raw values of 64
    // bits.
    std::string line = fmt::format(R"({{"t_s":{},"bus":{},"transmitted":{},"id":{})", frame.t_s,
                                   quoted(entry.interface), entry.transmitted, entry.frame.id);
    if (frame.is_group) {
      line += fmt::format(R"(,"source":{})", wire::j1939_source(entry.frame.id));
      if (const auto destination = wire::j1939_destination(entry.frame.id))
        line += fmt::format(R"(,"destination":{})", *destination);
    }
    std::string signals, missing;
    for (const SignalValue& value : frame.values) {
      const std::string name = quoted(signal_of(frame, value).name);
      if (value.text.empty()) {
        missing += (missing.empty() ? "" : ",") + name;
      } else {
        signals += fmt::format("{}{}:{}", signals.empty() ? "" : ",", name, number(value.text));
      }
    }
    line += fmt::format(R"(,"message":{},"signals":{{{}}})", quoted(frame.message.name), signals);
    if (!missing.empty()) line += fmt::format(R"(,"missing":[{}])", missing);
    give_(line + "}\n");
  }

 private:
  static std::string quoted(const std::string& text) {
    using Json = nlohmann::json;
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  // JSON has no numbers that are not finite.
  static std::string_view number(std::string_view text) {
    return text.ends_with("nan") || text.ends_with("inf") ? "null" : text;
  }
  const Sink& give_;
};

}  // namespace

std::unique_ptr<LineWriter> line_writer(Format format, const dbc::Database& database, bool with_groups,
                                        const Sink& give) {
  if (format == Format::csv) return std::make_unique<Csv>(database, with_groups, give);
  if (format == Format::json_lines) return std::make_unique<JsonLines>(give);
  return std::make_unique<Text>(give);
}

}  // namespace canhil::recordings
