#include "bench/campaign/matrix/drawn.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "bench/observe/values.hpp"
#include "bench/sensors/measurands.hpp"
#include "bench/world/hash.hpp"
#include "messages/canhil.hpp"

namespace canhil::campaign::matrix {
namespace {

// Draws the random numbers of one fault.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}

  double between(double low, double high) {
    constexpr double unit = 0x1p-53;  // 53 random bits make a double in [0, 1)
    return low + (high - low) * unit * static_cast<double>(engine_() >> 11U);
  }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(between(0, static_cast<double>(count))));
  }
  template <class Range>
  const auto& one_of(const Range& range) {
    return range[below(range.size())];
  }
  /// Log-uniform magnitude with random sign.
  double of_any_size(double low, double high) {
    const double size = std::pow(10, between(std::log10(low), std::log10(high)));
    return between(0, 1) < 0.5 ? -size : size;
  }

 private:
  std::mt19937_64 engine_;
};

enum class Affects : std::uint8_t {
  frames,  // all messages of a node
  value,   // one signal of a node's messages
  pair,    // two quantities of a node
  node,
  bus
};
enum class Times : std::uint8_t { each, seldom, stretch, begins };

// How the value of a fault's additional key (Kind::key) is distributed.
enum class Size : std::uint8_t {
  none,
  within,    // anywhere in the signal's range
  range,     // a fraction of the signal's range, with log-uniform size and random sign
  positive,  // a fraction of the signal's range, log-uniform, positive
  number,
  whole
};
struct Kind {
  std::string_view name;
  Affects affects;
  Times times;
  std::string_view key{};
  Size size = Size::none;
  double low = 0, high = 0;
};

constexpr std::array table{
    Kind{"changed", Affects::value, Times::each, "value", Size::within},
    Kind{"bias", Affects::value, Times::each, "by", Size::range, 1e-5, 0.1},
    Kind{"drift", Affects::value, Times::each, "by", Size::range, 1e-5, 0.1},
    Kind{"spike", Affects::value, Times::seldom, "by", Size::range, 1e-3, 0.5},
    Kind{"stuck", Affects::value, Times::each},
    Kind{"saturated", Affects::value, Times::each, "at", Size::positive, 1e-4, 0.5},
    Kind{"noise", Affects::value, Times::each, "sigma", Size::positive, 1e-5, 1e-2},
    Kind{"reversed", Affects::value, Times::each},
    Kind{"swapped", Affects::pair, Times::each},
    Kind{"invalid", Affects::node, Times::each},
    Kind{"late", Affects::node, Times::each, "by_ms", Size::number, 0.5, 50},
    Kind{"silent", Affects::node, Times::stretch},
    Kind{"slow", Affects::node, Times::stretch, "longer_percent", Size::number, 1, 100},
    Kind{"clock_step", Affects::node, Times::stretch, "by_ms", Size::number, -50, 50},
    Kind{"clock_drift", Affects::node, Times::stretch, "by_ppm", Size::number, -1000, 1000},
    Kind{"restart", Affects::node, Times::begins, "silent_s", Size::number, 0.01, 0.5},
    Kind{"lost", Affects::frames, Times::each},
    Kind{"repeated", Affects::frames, Times::each},
    Kind{"delayed", Affects::frames, Times::each, "by_ms", Size::number, 0.5, 50},
    Kind{"reordered", Affects::frames, Times::each},
    Kind{"damaged", Affects::frames, Times::each},
    Kind{"wrong_crc", Affects::frames, Times::each},
    Kind{"counter_stuck", Affects::frames, Times::each},
    Kind{"counter_jump", Affects::frames, Times::each, "by", Size::whole, 1, 14},
    Kind{"too_short", Affects::frames, Times::each},
    Kind{"foreign", Affects::frames, Times::each},
    Kind{"stranger", Affects::bus, Times::stretch, "period_ms", Size::number, 0.5, 20},
    Kind{"flood", Affects::bus, Times::stretch, "period_us", Size::whole, 100, 1000},
};

const Kind& kind_of(std::string_view name) { return *std::ranges::find(table, name, &Kind::name); }

std::string in_quotes(std::string_view text) { return fmt::format("\"{}\"", text); }

std::vector<const MessageInfo*> messages_of(const scenario::NodeTable& node) {
  std::vector<const MessageInfo*> group;
  for (const MessageInfo& info : messages::all_messages) {
    if (is_in_group_of(info, *node.closes)) group.push_back(&info);
  }
  return group;
}

double drawn_size(const Kind& kind, const SignalInfo* signal, Draw& draw) {
  switch (kind.size) {
    case Size::within:
      return draw.between(signal->minimum, signal->maximum);
    case Size::range:
      return (signal->maximum - signal->minimum) * draw.of_any_size(kind.low, kind.high);
    case Size::positive:
      return (signal->maximum - signal->minimum) * std::abs(draw.of_any_size(kind.low, kind.high));
    case Size::number:
      return draw.between(kind.low, kind.high);
    case Size::whole:
      return std::floor(draw.between(kind.low, kind.high + 1));
    case Size::none:
      break;
  }
  return 0;
}

// Draws a signal. Flags are excluded, except for the kind `changed`.
const SignalInfo* draw_signal(const Kind& kind, const MessageInfo& message, Draw& draw) {
  std::vector<const SignalInfo*> signals = observe::signals_of(message);
  if (kind.size != Size::within)
    std::erase_if(signals, [](const SignalInfo* signal) { return signal->length == 1; });
  return signals.empty() ? nullptr : draw.one_of(signals);
}

// Draws two quantities of the same unit. Returns false if the node has no such pair.
bool draw_pair(FaultText& fault, std::string_view node, Draw& draw) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const sensors::Measurand& one : sensors::measurands()) {
    for (const sensors::Measurand& other : sensors::measurands()) {
      if (one.sensor->key == node && other.sensor == one.sensor && one.si == other.si &&
          one.over == other.over && one.name < other.name)
        pairs.emplace_back(one.name, other.name);
    }
  }
  if (pairs.empty()) return false;
  const auto& [one, other] = draw.one_of(pairs);
  fault.set("quantity", in_quotes(one));
  fault.set("with", in_quotes(other));
  return true;
}

// Draws the times of a fault. The fault begins late enough that the flight before the fault can be compared
// with the flight during the fault. It ends early enough for a recovery, and lasts at least two periods of
// the node.
void draw_times(FaultText& fault, Times times, double duration_s, double period_s, Draw& draw) {
  constexpr std::array often{1, 2, 5, 10}, seldom{5, 10, 20, 50};
  const double from_s = duration_s * draw.between(0.3, 0.6);
  const double length_s = std::max(duration_s * draw.between(0.01, 0.15), 2 * period_s);
  fault.set("from_s", fmt::format("{:.3f}", from_s));
  if (times != Times::begins) fault.set("to_s", fmt::format("{:.3f}", from_s + length_s));
  if (times == Times::each || times == Times::seldom)
    fault.set("every", std::to_string(draw.one_of(times == Times::each ? often : seldom)));
}

std::optional<FaultText> draw_fault(const Drawn& row, const Column& column, Draw& draw) {
  const Kind& kind = kind_of(row.kind);
  const scenario::NodeSettings* node = column.scenario.node(row.node);
  if (kind.affects != Affects::bus && node == nullptr) return std::nullopt;
  FaultText fault;
  fault.set("kind", in_quotes(kind.name));
  const SignalInfo* signal = nullptr;
  switch (kind.affects) {
    case Affects::value: {
      const MessageInfo& message = *draw.one_of(messages_of(node->table()));
      signal = draw_signal(kind, message, draw);
      if (signal == nullptr) return std::nullopt;
      fault.set("messages", fmt::format("[{}]", in_quotes(message.name)));
      fault.set("signal", in_quotes(signal->name));
      break;
    }
    case Affects::pair:
      if (!draw_pair(fault, row.node, draw)) return std::nullopt;
      break;
    case Affects::frames:
    case Affects::node:
      fault.set("node", in_quotes(row.node));
      break;
    case Affects::bus:
      break;
  }
  const double size = drawn_size(kind, signal, draw);
  if (kind.size == Size::number)
    fault.set(kind.key, fmt::format("{:.3f}", size));  // a time in ms is a whole number of us
  else if (kind.size != Size::none)
    fault.set(kind.key, fmt::format("{:.6g}", size));
  const double period_s = node == nullptr ? 0 : 1e-6 * static_cast<double>(node->period_us());
  draw_times(fault, kind.times, 1e-6 * static_cast<double>(column.scenario.duration_us), period_s, draw);
  return fault;
}

Draw draw_of(const Column& column, std::uint64_t seed, std::uint64_t run, std::string_view row) {
  return Draw(world::fnv1a_64(fmt::format("{} {} {} {}", seed, row, column.scenario.title, run)));
}

}  // namespace

std::vector<Drawn> drawn_rows(const std::vector<std::string_view>& nodes) {
  std::vector<Drawn> rows;
  for (const Kind& kind : table) {
    if (kind.affects == Affects::bus) {
      rows.push_back({.kind = kind.name});
      continue;
    }
    for (const std::string_view node : nodes) rows.push_back({.kind = kind.name, .node = node});
  }
  return rows;
}

std::optional<FaultText> drawn_fault(const Drawn& row, const Column& column, std::uint64_t seed,
                                     std::uint64_t run) {
  Draw draw = draw_of(column, seed, run, fmt::format("{} {}", row.kind, row.node));
  auto fault = draw_fault(row, column, draw);
  // A row that fits in run 0 has a fault in each run: a message without a signal that fits is drawn again.
  constexpr int attempts = 1000;
  for (int i = 0; run > 0 && !fault && i < attempts; ++i) fault = draw_fault(row, column, draw);
  return fault;
}

bool fits(const Drawn& row, const Column& column, std::uint64_t seed) {
  const auto fault = drawn_fault(row, column, seed, 0);
  return fault && scenario_of(column, 0, {*fault});
}

std::vector<FaultText> drawn_faults(int count, const std::vector<Drawn>& rows, const Column& column,
                                    std::uint64_t seed, std::uint64_t run) {
  Draw draw = draw_of(column, seed, run, fmt::format("{} at once", count));
  std::vector<FaultText> faults;
  while (faults.size() < static_cast<std::size_t>(count)) {
    if (auto fault = draw_fault(draw.one_of(rows), column, draw)) faults.push_back(std::move(*fault));
  }
  return faults;
}

}  // namespace canhil::campaign::matrix
