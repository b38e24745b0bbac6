#include "bench/recordings/decode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "dbc/logs/log.hpp"
#include "dbc/parser/codec.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::recordings {
namespace {

using Values = std::vector<dbc::DecodedSignal>;

std::string number(double value) { return fmt::format("{:.12g}", value); }

// Base class: writes decoded frames in one output format.
class Writer {
 public:
  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  virtual ~Writer() = default;
  virtual std::string head() { return {}; }
  virtual std::string line(const LogEntry& entry, const std::string& t_s, const dbc::Message& message,
                           const Values& values) = 0;
};

class Text final : public Writer {
 public:
  std::string line(const LogEntry& entry, const std::string& t_s, const dbc::Message& message,
                   const Values& values) override {
    std::string text =
        fmt::format("{:>12}  {} {} {}:", t_s, entry.interface, entry.transmitted ? "T" : "R", message.name);
    for (const dbc::DecodedSignal& one : values) {
      text += fmt::format(" {}={}", one.signal->name, number(one.value));
      if (!one.signal->unit.empty()) text += " " + one.signal->unit;
      const std::string_view name =
          dbc::value_name(*one.signal, dbc::raw_bits(*one.signal, entry.frame.payload()));
      if (!name.empty()) text += fmt::format(" ({})", name);
    }
    return one_line(text) + "\n";
  }
};

class Csv final : public Writer {
 public:
  explicit Csv(const std::vector<const dbc::Message*>& messages) {
    for (const dbc::Message* message : messages) {
      for (const dbc::Signal& signal : message->signals) {
        places_.emplace(&signal, places_.size());
        head_ += "," + for_csv(message->name + "." + signal.name);
      }
    }
  }
  std::string head() override { return "t_s,bus" + head_ + "\n"; }
  std::string line(const LogEntry& entry, const std::string& t_s, const dbc::Message& /*message*/,
                   const Values& values) override {
    std::vector<std::string> cells(places_.size());
    for (const dbc::DecodedSignal& one : values) cells[places_.at(one.signal)] = number(one.value);
    std::string text = t_s + "," + for_csv(entry.interface);
    for (const std::string& one : cells) text += "," + one;
    return text + "\n";
  }

 private:
  std::map<const dbc::Signal*, std::size_t> places_;  // the column number of each signal
  std::string head_;
};

class JsonLines final : public Writer {
 public:
  std::string line(const LogEntry& entry, const std::string& t_s, const dbc::Message& message,
                   const Values& values) override {
    using Json = nlohmann::ordered_json;
    Json signals = Json::object();
    for (const dbc::DecodedSignal& one : values) signals[one.signal->name] = one.value;
    const Json json{{"bus", entry.interface},
                    {"transmitted", entry.transmitted},
                    {"id", message.id},
                    {"message", message.name},
                    {"signals", std::move(signals)}};
    // The time is inserted as text: a double cannot represent nanoseconds since 1970 exactly.
    return fmt::format("{{\"t_s\":{},{}\n", t_s,
                       json.dump(-1, ' ', false, Json::error_handler_t::replace).substr(1));
  }
};

class Decoder {
 public:
  Decoder(const dbc::Database& database, const DecodeOptions& options) : options_(options) {
    for (const dbc::Message& message : database.messages)
      by_id_.emplace(std::pair(message.id, message.extended), &message);
  }

  // Calls take(entry, message) for each frame of a selected message.
  template <class Take>
  Result<void> each(Result<LogReader> reader, const Take& take) {
    if (!reader) return tl::unexpected(reader.error());
    left_out_ = {};
    for (;;) {
      auto entry = reader->next();
      if (!entry) return tl::unexpected(entry.error());
      if (!*entry) {
        left_out_.remarks = reader->remarks();
        return {};
      }
      const Frame& frame = (*entry)->frame;
      if (!first_ns_) first_ns_ = (*entry)->t_ns;
      const auto found = by_id_.find({frame.id, frame.extended});
      if (found == by_id_.end() || frame.error) {
        ++left_out_.frames;
        left_out_.ids.insert(frame.error ? "error frames" : fmt::format("{:X}", frame.id));
      } else if (frame.size != found->second->size) {
        ++left_out_.frames;
        ++left_out_.of_another_size;
      } else if (options_.only.empty() ||
                 std::ranges::find(options_.only, found->second->name) != options_.only.end()) {
        take(**entry, *found->second);
      }
    }
  }
  [[nodiscard]] std::string time_of(const LogEntry& entry) const {
    const std::int64_t t_ns = options_.since_1970 ? entry.t_ns : entry.t_ns - first_ns_.value_or(0);
    const std::int64_t size_ns =
        std::abs(t_ns);  // t_ns is negative if a stamp is earlier than the first stamp
    constexpr std::int64_t ns_per_s = 1'000'000'000;
    std::string text = fmt::format("{}{}.{:09}", t_ns < 0 ? "-" : "", size_ns / ns_per_s, size_ns % ns_per_s);
    if (text.ends_with("000")) text.resize(text.size() - 3);
    return text;
  }
  [[nodiscard]] const LeftOut& left_out() const { return left_out_; }

 private:
  const DecodeOptions& options_;
  std::map<std::pair<std::uint32_t, bool>, const dbc::Message*> by_id_;
  std::optional<std::int64_t> first_ns_;
  LeftOut left_out_;
};

}  // namespace

Result<LeftOut> decode(const std::string& log, const dbc::Database& database, const DecodeOptions& options,
                       const Sink& give) {
  for (const std::string& name : options.only) {
    if (std::ranges::find(database.messages, name, &dbc::Message::name) == database.messages.end())
      return failure(fmt::format("--only '{}': the DBC has no such message, expected one that it has", name));
  }
  Decoder decoder(database, options);
  std::unique_ptr<Writer> writer;
  std::optional<LogFile> read_twice;  // a table begins with the names of its columns
  if (options.format == Format::csv) {
    auto file = LogFile::open(log);
    if (!file) return tl::unexpected(file.error());
    read_twice = std::move(*file);
    std::set<const dbc::Message*> seen;
    auto read = decoder.each(read_twice->read(),
                             [&](const LogEntry&, const dbc::Message& message) { seen.insert(&message); });
    if (!read) return tl::unexpected(read.error());
    std::vector<const dbc::Message*> messages;  // the messages that occur in the log, in the order of the DBC
    for (const dbc::Message& message : database.messages) {
      if (seen.contains(&message)) messages.push_back(&message);
    }
    writer = std::make_unique<Csv>(messages);
  } else if (options.format == Format::json_lines) {
    writer = std::make_unique<JsonLines>();
  } else {
    writer = std::make_unique<Text>();
  }
  give(writer->head());
  auto read = decoder.each(read_twice ? read_twice->read() : LogReader::open(log),
                           [&](const LogEntry& entry, const dbc::Message& message) {
                             const auto values = dbc::decode(message, entry.frame.payload());
                             if (values) give(writer->line(entry, decoder.time_of(entry), message, *values));
                           });
  if (!read) return tl::unexpected(read.error());
  return decoder.left_out();
}

}  // namespace canhil::recordings
