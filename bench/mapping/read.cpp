#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>

#include "bench/mapping/join.hpp"
#include "bench/mapping/mapping.hpp"
#include "bench/mapping/own_quantities.hpp"
#include "bench/mapping/playable.hpp"
#include "bench/mapping/put_together.hpp"
#include "bench/mapping/read_flags.hpp"
#include "bench/mapping/read_protection.hpp"
#include "bench/mapping/read_reported.hpp"
#include "bench/mapping/reading.hpp"
#include "bench/mapping/signal_units.hpp"
#include "bench/quantities/wire_unit.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/hash.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/wire/frame_rules.hpp"
#include "dbc/wire/message_places.hpp"

namespace canhil::mapping {
namespace {

namespace fs = std::filesystem;
using scenario::Limits;
using scenario::Section;

constexpr std::size_t most_messages_of_a_play = 8;  // the capacity of nodes::Transmission
constexpr std::string_view time_word = "time";

template <class Range, class Name>
std::vector<std::string> names_of(const Range& range, Name name) {
  std::vector<std::string> names;
  for (const auto& one : range) names.emplace_back(std::invoke(name, one));
  return names;
}

class Reader {
 public:
  Reader(const std::string& file, std::string_view text, const ReadText& read_text)
      : mapping_(std::make_shared<Mapping>()),
        target_(mapping_->targets.emplace_back()),
        root_(Section::parse(text, file)),
        read_text_(read_text) {
    target_.file = file;
    mapping_->hash = world::fnv1a_64(text);
  }

  Result<std::shared_ptr<Mapping>> read() {
    const std::string named = root_.text("dbc");
    if (named.empty()) root_.reject("dbc", "is missing", "the file of the DBC");
    if (root_.error()) return tl::unexpected(*root_.error());
    const std::string file = (fs::path(target_.file).parent_path() / named).string();
    const auto text = read_text_(file);
    if (!text) return tl::unexpected(text.error());
    auto database = dbc::parse_leniently(*text, file);
    if (!database) return tl::unexpected(database.error());
    target_.database = std::move(*database);
    mapping_->files.push_back({.mapping = target_.file, .dbc = file});
    mapping_->dbc_hash = target_.database.hash;
    mapping_->hash = world::fnv1a_64(fmt::format("{:x} {:x}", mapping_->hash, target_.database.hash));
    target_.name = root_.text("name", fs::path(target_.file).stem().stem().string());
    if (auto units = root_.optional_table("units")) read_units(*units);
    if (auto own = root_.optional_table("quantities")) target_.own = read_own_quantities(*own);
    playable_ = Playable(root_.optional_table("sensors"));
    mapping_->sensors = playable_.named();
    signs_ = root_.texts("signs");
    for (Section& section : tables("protection")) read_protection(section);
    for (Section& section : tables("play")) read_play(section);
    for (Section& section : root_.tables("hear")) read_hear(section);
    expect_signs();
    if (auto channels = root_.optional_table("channels")) read_channels(*channels);
    root_.finish();
    if (const auto error = root_.error()) return tl::unexpected(*error);
    return mapping_;
  }

 private:
  std::vector<Section> tables(std::string_view key) {
    if (root_.has(key)) return root_.tables(key);
    root_.optional(key);
    return {};
  }

  const dbc::Message* message(Section& section, std::string_view key, const std::string& name) {
    const dbc::Message* found = dbc::find_message(target_.database, name);
    if (found == nullptr && !name.empty())
      section.reject(key, fmt::format("the DBC has no message '{}'", name), "the name of one");
    return found;
  }

  const dbc::Signal* signal(Section& section, std::string_view key, const dbc::Message* message,
                            std::string_view name) {
    const dbc::Signal* found = message == nullptr ? nullptr : dbc::find_signal(*message, name);
    if (found == nullptr && message != nullptr)
      section.reject(
          key, fmt::format("{} has no signal '{}'", message->name, name),
          fmt::format("one of: {}", fmt::join(names_of(message->signals, &dbc::Signal::name), ", ")));
    return found;
  }

  // Parses "MESSAGE.SIGNAL" for keys that may refer to any of several messages.
  std::pair<const dbc::Message*, const dbc::Signal*> signal_of(Section& section, std::string_view key,
                                                               std::string_view text) {
    const std::size_t dot = std::min(text.find('.'), text.size());
    const dbc::Message* of = message(section, key, std::string(text.substr(0, dot)));
    if (dot == text.size() && of != nullptr) section.reject(key, "names no signal", "MESSAGE.SIGNAL");
    const bool whole = of != nullptr && dot < text.size();
    return {of, whole ? signal(section, key, of, text.substr(dot + 1)) : nullptr};
  }

  void read_units(Section& section) {
    for (const std::string& key : section.keys()) {
      const auto [of, one] = signal_of(section, key, key);
      const std::string unit = section.text(key);
      if (one != nullptr && !unit.empty() && !units_.give(*one, unit))
        section.reject(key, fmt::format("'{}' is not a known unit", unit),
                       "one of: " + quantities::wire_units());
    }
    section.finish();
  }

  void read_protection(Section& section) {
    std::vector<const dbc::Message*> of;
    for (const std::string& name : section.texts("messages")) {
      if (const dbc::Message* one = message(section, "messages", name); one != nullptr) of.push_back(one);
    }
    if (of.empty() && !section.error())
      section.reject("messages", "names no message", "at least one message");
    for (const dbc::Message* one : of) {
      if (auto made = mapping::read_protection(section, *one)) protections_.insert_or_assign(one, *made);
    }
    section.finish();
  }

  Mapped mapped(Section& section, std::string_view key, const dbc::Message& message, bool of_target) {
    auto& all = mapping_->infos;
    const auto used = std::ranges::find(all, message.name, &MessageInfo::name);
    if (used != all.end() && (of_target || !is_multiplexed(message) || is_targets(*used)))
      section.reject(key, fmt::format("{} is already used", message.name),
                     "each message once, or each page of a multiplexed message that the bench sends");
    // dbc::parse_leniently() accepts any size, because DBC files also describe what transport protocols
    // carry.
    const bool fits_a_frame = !message.j1939_transport() && message.size <= 64 &&
                              size_has_dlc(static_cast<std::uint8_t>(message.size), true);
    constexpr unsigned most_bytes = std::numeric_limits<decltype(MessageInfo::size)>::max();
    if (message.size > most_bytes)
      section.reject(key, fmt::format("{} has {} bytes", message.name, message.size),
                     fmt::format("at most {}", most_bytes));
    if (!fits_a_frame && !message.fast_packet && !(message.j1939_transport() && of_target))
      section.reject(
          key,
          fmt::format("{} has {} bytes, which {}", message.name, message.size,
                      message.j1939_transport() ? "J1939 sends in several frames" : "no frame has"),
          "a message of one frame, a fast packet of NMEA 2000, or a message of J1939 that is heard: a "
          "mapping knows no ISO-TP, and plays nothing by the transport protocol of J1939");
    MessageInfo info{.name = message.name,
                     .id = message.id,
                     .extended = message.extended,
                     .fd = message.fd,
                     .size = static_cast<std::uint8_t>(message.size),
                     .cycle_time_us = message.cycle_time_us,
                     .sender = of_target ? target_node : bench_node};
    Mapped mapped(message);
    mapped.index = static_cast<std::size_t>(used - all.begin());
    if (used == all.end()) {
      all.push_back(info);
      mapping_->sent_by.push_back(of_target ? "" : message.sender);
    }
    if (const auto own = protections_.find(&message); own != protections_.end())
      mapped.protection = own->second;
    if (mapped.protection && mapped.has_several_frames())
      section.reject(key, fmt::format("{} has several frames and a [[protection]]", message.name),
                     "no counter and no checksum: NMEA 2000 and J1939 have none");
    return mapped;
  }

  void read_play(Section& section) {
    Play play;
    for (const std::string& name : section.texts("messages")) {
      const dbc::Message* one = message(section, "messages", name);
      if (one != nullptr)
        play.messages.push_back({.of = mapped(section, "messages", *one, false), .sources = {}});
    }
    if (section.error()) return;
    if (play.messages.empty() || play.messages.size() > most_messages_of_a_play)
      section.reject("messages", fmt::format("are {}", play.messages.size()),
                     fmt::format("1 to {}", most_messages_of_a_play));
    if (section.error()) return;
    const dbc::Message& last = *play.messages.back().of.message;
    play.name = last.name;
    if (section.has("every_ms") || last.cycle_time_us == 0)
      play.period_us = section.time_us("every_ms", Limits::above(0));
    else {
      section.optional("every_ms");
      play.period_us = last.cycle_time_us;
    }
    if (const std::string node = section.text("node", ""); !node.empty()) {
      for (const PlayedMessage& one : play.messages) mapping_->sent_by[one.of.index] = node;
    }
    play.latency_us = section.time_us("latency_ms", Limits::between(0, 10'000), 0);
    std::optional<Section> invalid = section.optional_table("invalid");
    Section signals = section.table("signals");
    for (const std::string& key : signals.keys()) {
      read_source(signals, key, play);
      if (invalid && invalid->has(key)) read_invalid(*invalid, key, play);
    }
    signals.finish();
    if (invalid) invalid->finish();
    if (std::ranges::find(mapping_->plays, play.name, &Play::name) != mapping_->plays.end())
      play.name += " " + page_of(play.messages.back());
    section.finish();
    mapping_->plays.push_back(std::move(play));
  }

  void read_source(Section& section, const std::string& key, Play& play) {
    const auto [of, one] = signal_of(section, key, key);
    const auto own =
        std::ranges::find(play.messages, of, [](const PlayedMessage& p) { return p.of.message; });
    if (of != nullptr && own == play.messages.end())
      section.reject(
          key, fmt::format("{} is not a message of this play", of->name),
          fmt::format(
              "one of: {}",
              fmt::join(names_of(play.messages, [](const PlayedMessage& p) { return p.of.message->name; }),
                        ", ")));
    if (!section.holds_text(key)) {
      const double value = section.plain_number(key, {});
      if (one != nullptr && !dbc::holds(*one, value))
        section.reject(key, fmt::format("{:g} does not fit into the signal", value),
                       "a value that it can hold");
      if (one != nullptr && own != play.messages.end())
        own->sources.push_back({.signal = one, .value = value});
      return;
    }
    std::string word = section.text(key);
    if (one == nullptr || own == play.messages.end() || section.error()) return;
    const double sign = word.starts_with('-') ? -1 : 1;
    if (sign < 0) word.erase(0, 1);
    if (word == time_word) {
      own->sources.push_back({.signal = one,
                              .time = true,
                              .factor = 1 / units_.factor(section, key, *of, *one, "s", time_word)});
      return;
    }
    const sensors::Measurand* measurand = playable_.find(word);
    if (measurand == nullptr) {
      section.reject(key, fmt::format("'{}' is not a quantity that a node measures", word),
                     fmt::format("one of: time, {}", fmt::join(playable_.names(), ", ")));
      return;
    }
    if (play.sensor == nullptr)
      play.sensor = measurand->sensor;  // of the first quantity: its samples trigger the play
    own->sources.push_back(
        {.signal = one,
         .measurand = measurand,
         .factor = sign / units_.factor(section, key, *of, *one, measurand->si, measurand->name)});
  }

  static void read_invalid(Section& section, const std::string& key, Play& play) {
    const auto raw = static_cast<std::uint64_t>(section.integer(key, 0));
    for (PlayedMessage& message : play.messages) {
      for (Source& source : message.sources) {
        if (message.of.message->name + "." + source.signal->name != key) continue;
        expect_bits(section, key, *source.signal, raw);
        source.invalid = raw;
      }
    }
  }

  void read_hear(Section& section) {
    const dbc::Message* of = message(section, "message", section.text("message"));
    if (of == nullptr) return;
    Hear hear{.of = mapped(section, "message", *of, true), .reported_signals = {}};
    if (section.flag("any_source")) {
      if (!of->extended)
        section.reject("any_source", "is for J1939, whose ids have 29 bits",
                       fmt::format("another message than {}", of->name));
      mapping_->by_group[wire::j1939_group(of->id)] = hear.of.index;
    }
    if (section.has("answers")) {
      // A play has the name of its last message. Another of its messages means it too, but is not what is
      // answered.
      std::string name = section.text("answers");
      const bool is_play = std::ranges::find(mapping_->plays, name, &Play::name) != mapping_->plays.end();
      for (const Play& one : mapping_->plays) {
        const bool is_part = std::ranges::any_of(
            one.messages, [&](const PlayedMessage& part) { return part.of.message->name == name; });
        if (!is_play && is_part)
          section.reject("answers", fmt::format("{} is not the last message of its play", name),
                         fmt::format("'{}'", one.name));
      }
      name = section.given_name("answers", names_of(mapping_->plays, &Play::name));
      const auto play = std::ranges::find(mapping_->plays, name, &Play::name);
      if (play != mapping_->plays.end())
        hear.answers = static_cast<std::size_t>(play - mapping_->plays.begin());
    }
    section.optional("answers");
    if (hear.answers) hear.task_us = section.optional_time_us("task_ms", Limits::above(0)).value_or(0);
    if (auto echo = section.optional_table("echo")) {
      if (!hear.answers)
        echo->reject("signal", "repeats nothing", "answers beside it");
      else
        read_echo(*echo, hear);
      echo->finish();
    }
    std::optional<Section> invalid = section.optional_table("invalid");
    if (auto signals = section.optional_table("signals"))
      read_reported(*signals, invalid, {.own = target_.own, .units = units_}, hear);
    if (invalid) invalid->finish();
    if (auto flags = section.optional_table("flags")) hear.flags = read_flags(*flags, *of, signs_);
    section.finish();
    mapping_->hears.push_back(std::move(hear));
  }

  // Each of `signs` must be a flag: a misspelt one would never be seen.
  void expect_signs() {
    std::vector<std::string> flags;
    for (const Hear& hear : mapping_->hears) {
      for (const ReportedFlag& flag : hear.flags) flags.push_back(flag.name);
    }
    for (const std::string& sign : signs_) {
      if (std::ranges::find(flags, sign) == flags.end())
        root_.reject("signs", fmt::format("'{}' is no flag of a [[hear]]", sign),
                     fmt::format("some of: {}", fmt::join(flags, ", ")));
    }
  }

  void read_channels(Section& section) {
    static const std::vector<std::string> transports{"frame", "iso_tp"};
    for (const std::string& name : section.keys()) {
      Section own = section.table(name);
      const dbc::Message* request = message(own, "request", own.text("request"));
      const std::string answer = own.text("response", "");
      const dbc::Message* response = answer.empty() ? nullptr : message(own, "response", answer);
      const bool iso_tp = own.one_of("transport", transports) == "iso_tp";
      if (iso_tp && answer.empty())
        own.missing("response", "the message of the answers, with which the target also paces requests");
      const std::int64_t padding =
          own.optional_integer("padding", 0).value_or(transport::IsoTpSettings{}.padding);
      if (padding > 0xFF) own.reject("padding", fmt::format("is {}", padding), "a byte");
      if (own.error() || request == nullptr) return;
      EventChannel channel{.name = name, .request = mapped(own, "request", *request, false)};
      if (response != nullptr) channel.response = mapped(own, "response", *response, true);
      if (iso_tp) channel.transport = EventChannel::Transport::iso_tp;
      channel.settings = {.frame_bytes = std::max<unsigned>(request->size, 8),
                          .padding = static_cast<std::uint8_t>(padding)};
      own.finish();
      mapping_->event_channels.push_back(std::move(channel));
    }
    section.finish();
  }

  void read_echo(Section& section, Hear& hear) {
    const dbc::Signal* repeated = signal(section, "signal", hear.of.message, section.text("signal"));
    const auto [of, original] = signal_of(section, "of", section.text("of"));
    const auto& own = mapping_->plays[*hear.answers].messages;
    const auto played = std::ranges::find(own, of, [](const PlayedMessage& p) { return p.of.message; });
    if (of != nullptr && played == own.end())
      section.reject("of", fmt::format("{} is not part of the play that it answers", of->name),
                     "one of its messages");
    if (played == own.end()) return;
    hear.echo = {.repeated = repeated,
                 .message = static_cast<std::size_t>(played - own.begin()),
                 .original = original};
  }

  std::shared_ptr<Mapping> mapping_;
  MappedTarget& target_;
  Section root_;
  const ReadText& read_text_;
  SignalUnits units_;
  Playable playable_;
  std::vector<std::string> signs_;  // names of flags
  std::map<const dbc::Message*, protection::Protection> protections_;
};

}  // namespace

Result<std::shared_ptr<Mapping>> read_alone(const std::string& file, const ReadText& read) {
  const auto text = read(file);
  if (!text) return tl::unexpected(text.error());
  return Reader(file, *text, read).read();
}

}  // namespace canhil::mapping
