// Reads the sections that define messages and signals.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "dbc/parser/reader.hpp"

namespace canhil::dbc {
namespace {

constexpr unsigned last_bit = 8 * largest_message - 1;

// Reads the indicator of a signal. M: the signal is a multiplexor. m3: the signal is present when its
// multiplexor has the value 3. m3M: both.
void read_mux_indicator(Reader& in, Signal& signal) {
  const std::string expected = "':' or a multiplexing indicator M, m<number> or m<number>M";
  std::string_view text = in.peek().text;
  if (text == "M") {
    signal.multiplexor = true;
  } else {
    if (!text.starts_with('m')) in.fail(expected);
    text.remove_prefix(1);
    if (text.ends_with('M')) {
      signal.multiplexor = true;
      text.remove_suffix(1);
    }
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size()) in.fail(expected);
    signal.mux_ranges = {{value, value}};
  }
  in.take();
}

bool names_no_node(const Reader& in) {
  return in.peek().kind == TokenKind::end || (in.peek().kind == TokenKind::word && !in.at_name());
}

// Reads the receivers of a signal. Commas separate them. In old files blanks separate them; then all are on
// one line.
void read_receivers(Reader& in, Draft& draft, Signal& signal) {
  Position at;
  const auto read_node = [&] {
    at = in.peek().at;
    std::string name = in.word("a receiver");
    if (name == nobody) return;
    check_node(draft, name, at);
    signal.receivers.push_back(std::move(name));
  };
  const auto follows = [&] { return in.take_mark_if(',') || (in.at_name() && in.peek().at.line == at.line); };
  do {
    if (names_no_node(in)) return in.report(Rule::missing_node, "a receiver");
    in.entry(read_node, [&] { return in.at_mark(',') || in.at_word("SG_"); });
  } while (follows());
}

Signal read_signal(Reader& in, Draft& draft) {
  Signal signal;
  signal.at = in.peek().at;
  signal.name = in.word("the name of a signal");
  if (in.peek().kind == TokenKind::word) read_mux_indicator(in, signal);
  in.mark(':');
  signal.start_bit =
      static_cast<unsigned>(in.natural_or(Rule::signal_beyond_message, "a start bit", last_bit));
  in.mark('|');
  signal.length = static_cast<unsigned>(in.natural_or(Rule::signal_length, "a length in bits", 512));
  in.mark('@');
  const bool intel = in.natural("the byte order 0 (Motorola) or 1 (Intel)", 1) == 1;
  signal.byte_order = intel ? ByteOrder::little_endian : ByteOrder::big_endian;
  if (!in.at_mark('+') && !in.at_mark('-')) in.fail("the sign '+' (unsigned) or '-' (signed)");
  signal.type = in.take().text == "-" ? RawType::signed_integer : RawType::unsigned_integer;
  in.mark('(');
  signal.scale = in.real("a scale");
  in.mark(',');
  signal.offset = in.real("an offset");
  in.mark(')');
  in.mark('[');
  signal.minimum = in.limit("a minimum");
  in.mark('|');
  signal.maximum = in.limit("a maximum");
  in.mark(']');
  signal.unit = in.string("a unit");
  read_receivers(in, draft, signal);
  return signal;
}

/// True if a frame can have the id of the message. False for the pseudo message VECTOR__INDEPENDENT_SIG_MSG,
/// which has no frame.
bool check_id(Draft& draft, const Message& message, std::uint32_t written_id) {
  if (message.id == independent_signals_id) {
    draft.findings.add(
        Rule::independent_signals, message.at,
        fmt::format("message {} has the id 0xC0000000: its signals are in no frame", message.name));
    return false;
  }
  const bool is_flagged = (written_id & extended_flag) != 0;
  const std::uint32_t last_id = is_flagged ? last_extended_id : last_standard_id;
  const std::uint32_t id = written_id & ~extended_flag;
  if (id <= last_id) return true;
  const bool is_possible = id <= last_extended_id;
  draft.findings.add(is_possible ? Rule::missing_extended_flag : Rule::impossible_id, message.at,
                     fmt::format("message id {} out of range, expected at most {}{}", id,
                                 is_possible ? last_standard_id : last_extended_id,
                                 is_possible ? ", or bit 31 set for an extended id" : ""));
  return is_possible;
}

void read_sender(Reader& in, Draft& draft, Message& message) {
  if (names_no_node(in)) return in.report(Rule::missing_node, "the sender");
  const Position at = in.peek().at;
  message.sender = in.word("the sender");
  if (message.sender == nobody) {
    message.sender.clear();
  } else {
    check_node(draft, message.sender, at);
  }
}

bool is_after_signals(const Reader& in) { return in.at_section() || in.peek().kind == TokenKind::end; }

void skip_to_next_signal(Reader& in) {
  while (!in.at_word("SG_") && !is_after_signals(in)) in.take();
}

/// Reads a signal of the current message. If the signal is unreadable, skips the tokens before the next
/// signal or section.
void read_next_signal(Reader& in, Draft& draft) {
  Signal signal;
  try {
    signal = read_signal(in, draft);
  } catch (const SectionFailure& failure) {
    draft.findings.add(Rule::unreadable_signal, failure.at, failure.what);
    return skip_to_next_signal(in);
  }
  Message& message = draft.database.messages.back();
  if (!draft.signals.back().emplace(signal.name, message.signals.size()).second) {
    draft.findings.add(Rule::duplicate_signal, signal.at,
                       fmt::format("signal {}.{} is defined a second time, expected a unique name",
                                   message.name, signal.name));
  }
  message.signals.push_back(std::move(signal));
}

}  // namespace

void read_message(Reader& in, Draft& draft) {
  Message message;
  message.at = in.peek().at;
  const auto written_id = static_cast<std::uint32_t>(in.natural("a message id", UINT32_MAX));
  const auto raw_id = static_cast<std::uint32_t>(text_id(written_id));
  message.extended = (raw_id & extended_flag) != 0;
  message.id = raw_id == independent_signals_id ? raw_id : raw_id & ~extended_flag;
  const Position name_at = in.peek().at;
  message.name = in.word("the name of the message");
  in.mark(':');
  message.size =
      static_cast<unsigned>(in.natural_or(Rule::message_size, "the size in bytes", largest_message));
  read_sender(in, draft, message);
  const bool is_kept = check_id(draft, message, written_id);
  const std::size_t index = draft.database.messages.size();
  const auto [other, is_new] = draft.messages_by_id.emplace(raw_id, index);
  if (!is_new) {
    draft.findings.add(Rule::duplicate_id, message.at,
                       fmt::format("message {} has the id {} of {}, expected a unique id", message.name,
                                   message.id, draft.database.messages[other->second].name));
  } else if (!draft.messages.emplace(message.name, index).second) {
    draft.findings.add(
        Rule::duplicate_message, name_at,
        fmt::format("message {} is defined a second time, expected a unique name", message.name));
  }
  draft.left_out.push_back(!is_kept || !is_new || message.size > largest_message);
  draft.database.messages.push_back(std::move(message));
  draft.signals.emplace_back();
  while (!is_after_signals(in)) {
    if (in.at_word("SG_")) {
      in.take();
      read_next_signal(in, draft);
    } else {  // a line between the signals of a message does not cost the signals that follow it
      in.report(Rule::unknown_section, "a section such as BO_, CM_ or BA_");
      skip_to_next_signal(in);
    }
  }
}

void read_transmitters(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  Message& message = message_of(draft, in.natural("a message id", UINT32_MAX), at);
  in.mark(':');
  const auto read_node = [&] {
    const Position node_at = in.peek().at;
    const std::string node = in.word("';' or a sender");
    if (node == nobody) return;
    check_node(draft, node, node_at);
    if (node != message.sender) message.further_senders.push_back(node);
  };
  while (!in.at_section_end()) {
    in.entry(read_node, [&] { return in.at_mark(',') || in.at_name(); });
    in.take_mark_if(',');
  }
  in.semicolon();
}

void read_signal_group(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  Message& message = message_of(draft, in.natural("a message id", UINT32_MAX), at);
  SignalGroup group;
  group.name = in.word("the name of the signal group");
  group.repetitions = static_cast<int>(in.natural("the repetitions", INT32_MAX));
  in.mark(':');
  const auto read_name = [&] {
    const Position signal_at = in.peek().at;
    std::string signal = in.word("';' or a signal");
    signal_of(draft, message, signal, signal_at);
    group.signals.push_back(std::move(signal));
  };
  while (!in.at_section_end()) {
    in.entry(read_name, [&] { return in.at_mark(',') || in.at_name(); });
    in.take_mark_if(',');
  }
  in.semicolon();
  message.groups.push_back(std::move(group));
}

void read_signal_type(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  Message& message = message_of(draft, in.natural("a message id", UINT32_MAX), at);
  const Position signal_at = in.peek().at;
  Signal& signal = signal_of(draft, message, in.word("a signal"), signal_at);
  in.take_mark_if(':');
  const std::uint64_t type = in.natural("the type 0 (integer), 1 (float) or 2 (double)", 2);
  in.semicolon();
  if (type == 0) return;
  const unsigned length = type == 1 ? 32 : 64;
  if (signal.length != length) {
    draft.findings.add(Rule::float_length, signal_at,
                       fmt::format("signal {}.{} has {} bits, expected {} for a {}", message.name,
                                   signal.name, signal.length, length, type == 1 ? "float" : "double"));
  }
  if (signal.length == 32) signal.type = RawType::float32;
  if (signal.length == 64) signal.type = RawType::float64;
}

void read_extended_mux(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  const std::uint64_t id = in.natural("a message id", UINT32_MAX);
  Message& message = message_of(draft, id, at);
  const Position signal_at = in.peek().at;
  Signal& signal = signal_of(draft, message, in.word("a multiplexed signal"), signal_at);
  const Position mux_at = in.peek().at;
  Signal& multiplexor = signal_of(draft, message, in.word("its multiplexor"), mux_at);
  if (!draft.mux_extended.emplace(fmt::format("{} {}", text_id(id), signal.name), signal_at).second) {
    fail_at(Rule::duplicate_multiplexing, signal_at,
            fmt::format("multiplexing of {}.{} a second time, expected SG_MUL_VAL_ once", message.name,
                        signal.name));
  }
  if (signal.mux_ranges.empty()) {
    draft.findings.add(
        Rule::indicator_missing, signal_at,
        fmt::format("signal {}.{} is not multiplexed, expected the indicator m<number> in its SG_",
                    message.name, signal.name));
  }
  if (!multiplexor.multiplexor) {
    draft.findings.add(Rule::indicator_missing, mux_at,
                       fmt::format("signal {}.{} is not a multiplexor, expected the indicator M in its SG_",
                                   message.name, multiplexor.name));
    multiplexor.multiplexor = true;
  }
  std::vector<MuxRange> ranges;
  const auto read_range = [&] {
    const Position range_at = in.peek().at;
    MuxRange range;
    range.first = in.natural("a range first-last", UINT64_MAX);
    // The lexer reads "3-5" as the numbers 3 and -5.
    if (in.peek().kind == TokenKind::number && in.peek().text.starts_with('-')) {
      range.last = in.natural_after_minus("the last value");
    } else {
      in.mark('-');
      range.last = in.natural("the last value", UINT64_MAX);
    }
    if (range.first > range.last) {
      draft.findings.add(
          Rule::empty_range, range_at,
          fmt::format("range {}-{} is empty, expected first <= last", range.first, range.last));
    }
    ranges.push_back(range);
  };
  do {
    in.entry(read_range, [&] { return in.at_mark(','); });
  } while (in.take_mark_if(','));
  in.semicolon();
  signal.multiplexed_by = multiplexor.name;
  if (!ranges.empty()) signal.mux_ranges = std::move(ranges);
}

}  // namespace canhil::dbc
