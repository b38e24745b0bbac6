// The sections that define messages and signals.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "dbc/parser/reader.hpp"

namespace canhil::dbc {
namespace {

// M: multiplexor; m3: there when it is 3; m3M: both.
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

// Separated by commas, in old files by blanks on one line.
void read_receivers(Reader& in, Draft& draft, Signal& signal) {
  Position at;
  const auto follows = [&] {
    return in.take_mark_if(',') ||
           (in.peek().kind == TokenKind::word && in.peek().at.line == at.line && !is_keyword(in.peek().text));
  };
  do {
    at = in.peek().at;
    std::string name = in.word("a receiver");
    if (name == nobody) continue;
    node_of(draft, name, at);
    signal.receivers.push_back(std::move(name));
  } while (follows());
}

Signal read_signal(Reader& in, Draft& draft) {
  Signal signal;
  signal.at = in.peek().at;
  signal.name = in.word("the name of a signal");
  if (in.peek().kind == TokenKind::word) read_mux_indicator(in, signal);
  in.mark(':');
  signal.start_bit = static_cast<unsigned>(in.natural("a start bit", 511));
  in.mark('|');
  signal.length = static_cast<unsigned>(in.natural("a length in bits", 512));
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
  signal.minimum = in.real("a minimum");
  in.mark('|');
  signal.maximum = in.real("a maximum");
  in.mark(']');
  signal.unit = in.string("a unit");
  read_receivers(in, draft, signal);
  return signal;
}

}  // namespace

void read_message(Reader& in, Draft& draft) {
  Message message;
  message.at = in.peek().at;
  const auto raw_id = static_cast<std::uint32_t>(in.natural("a message id", UINT32_MAX));
  message.extended = (raw_id & extended_flag) != 0;
  message.id = raw_id == independent_signals_id ? raw_id : raw_id & ~extended_flag;
  const std::uint32_t last_id = message.extended ? 0x1FFF'FFFFU : 0x7FFU;
  if (message.id > last_id && message.id != independent_signals_id) {
    fail_at(message.at, fmt::format("message id {} out of range, expected at most {}{}", message.id, last_id,
                                    message.extended ? "" : ", or bit 31 set for an extended id"));
  }
  const Position name_at = in.peek().at;
  message.name = in.word("the name of the message");
  const std::size_t index = draft.database.messages.size();
  if (const auto [other, is_new] = draft.messages_by_id.emplace(raw_id, index); !is_new) {
    fail_at(message.at, fmt::format("message {} has the id {} of {}, expected an id of its own", message.name,
                                    message.id, draft.database.messages[other->second].name));
  }
  if (!draft.messages.emplace(message.name, index).second)
    fail_at(name_at, fmt::format("message {} a second time, expected a name of its own", message.name));
  in.mark(':');
  message.size = static_cast<unsigned>(in.natural("the size in bytes", 64));
  const Position sender_at = in.peek().at;
  message.sender = in.word("the sender");
  if (message.sender == nobody) {
    message.sender.clear();
  } else {
    node_of(draft, message.sender, sender_at);
  }
  Index& signals = draft.signals.emplace_back();
  while (in.at_word("SG_")) {
    in.take();
    Signal signal = read_signal(in, draft);
    if (!signals.emplace(signal.name, message.signals.size()).second) {
      fail_at(signal.at, fmt::format("signal {}.{} a second time, expected a name of its own", message.name,
                                     signal.name));
    }
    message.signals.push_back(std::move(signal));
  }
  draft.database.messages.push_back(std::move(message));
}

void read_transmitters(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  Message& message = message_of(draft, in.natural("a message id", UINT32_MAX), at);
  in.mark(':');
  while (!in.take_mark_if(';')) {
    const Position node_at = in.peek().at;
    const std::string node = in.word("';' or a sender");
    if (node != nobody) {
      node_of(draft, node, node_at);
      if (node != message.sender) message.further_senders.push_back(node);
    }
    in.take_mark_if(',');
  }
}

void read_signal_group(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  Message& message = message_of(draft, in.natural("a message id", UINT32_MAX), at);
  SignalGroup group;
  group.name = in.word("the name of the signal group");
  group.repetitions = static_cast<int>(in.natural("the repetitions", INT32_MAX));
  in.mark(':');
  while (!in.take_mark_if(';')) {
    const Position signal_at = in.peek().at;
    group.signals.push_back(in.word("';' or a signal"));
    signal_of(draft, message, group.signals.back(), signal_at);
    in.take_mark_if(',');
  }
  message.groups.push_back(std::move(group));
}

void read_signal_type(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  Message& message = message_of(draft, in.natural("a message id", UINT32_MAX), at);
  const Position signal_at = in.peek().at;
  Signal& signal = signal_of(draft, message, in.word("a signal"), signal_at);
  in.take_mark_if(':');
  const std::uint64_t type = in.natural("the type 0 (integer), 1 (float) or 2 (double)", 2);
  in.mark(';');
  if (type == 0) return;
  const unsigned length = type == 1 ? 32 : 64;
  if (signal.length != length) {
    fail_at(signal_at, fmt::format("signal {}.{} has {} bits, expected {} for a {}", message.name,
                                   signal.name, signal.length, length, type == 1 ? "float" : "double"));
  }
  signal.type = type == 1 ? RawType::float32 : RawType::float64;
}

void read_extended_mux(Reader& in, Draft& draft) {
  const Position at = in.peek().at;
  const std::uint64_t id = in.natural("a message id", UINT32_MAX);
  Message& message = message_of(draft, id, at);
  const Position signal_at = in.peek().at;
  Signal& signal = signal_of(draft, message, in.word("a multiplexed signal"), signal_at);
  const Position mux_at = in.peek().at;
  const Signal& multiplexor = signal_of(draft, message, in.word("its multiplexor"), mux_at);
  if (!draft.mux_extended.emplace(fmt::format("{} {}", id, signal.name), signal_at).second) {
    fail_at(signal_at, fmt::format("multiplexing of {}.{} a second time, expected SG_MUL_VAL_ once",
                                   message.name, signal.name));
  }
  if (signal.mux_ranges.empty()) {
    fail_at(signal_at,
            fmt::format("signal {}.{} is not multiplexed, expected the indicator m<number> in its SG_",
                        message.name, signal.name));
  }
  if (!multiplexor.multiplexor) {
    fail_at(mux_at, fmt::format("signal {}.{} is no multiplexor, expected the indicator M in its SG_",
                                message.name, multiplexor.name));
  }
  signal.multiplexed_by = multiplexor.name;
  signal.mux_ranges.clear();
  do {
    const Position range_at = in.peek().at;
    MuxRange range;
    range.first = in.natural("a range first-last", UINT64_MAX);
    // "3-5" is read as the numbers 3 and -5.
    if (in.peek().kind == TokenKind::number && in.peek().text.starts_with('-')) {
      range.last = in.natural_after_minus("the last value");
    } else {
      in.mark('-');
      range.last = in.natural("the last value", UINT64_MAX);
    }
    if (range.first > range.last) {
      fail_at(range_at, fmt::format("range {}-{} is empty, expected first <= last", range.first, range.last));
    }
    signal.mux_ranges.push_back(range);
  } while (in.take_mark_if(','));
  in.mark(';');
}

}  // namespace canhil::dbc
