#include "bench/recordings/compare_stamps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "dbc/logs/log.hpp"

namespace canhil::recordings {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t most_apart_ns = 5'000'000;
constexpr std::int64_t drift_over =
    64;  // memory of the moving average that tracks the clock difference, in frames

struct Stamped {
  std::int64_t t_ns = 0;
  Frame frame;
};

// The id and the data of a frame as one string, which is the key of a hash table.
std::string content_of(const Frame& frame) {
  std::string content = fmt::format("{:x}{}{}:", frame.id, frame.extended ? "x" : "", frame.fd ? "f" : "");
  for (const std::uint8_t byte : frame.payload()) content.push_back(static_cast<char>(byte));
  return content;
}

Result<std::vector<Stamped>> read_all(const std::string& log) {
  auto reader = LogReader::open(log);
  if (!reader) return tl::unexpected(reader.error());
  std::vector<Stamped> frames;
  for (;;) {
    auto entry = reader->next();
    if (!entry) return tl::unexpected(entry.error());
    if (!*entry) break;
    if (!(*entry)->frame.error) frames.push_back({(*entry)->t_ns, (*entry)->frame});
  }
  if (frames.empty()) return failure(fmt::format("{}: no frame, expected a recording", log));
  std::ranges::stable_sort(frames, {}, &Stamped::t_ns);
  return frames;
}

using TimesByContent = std::unordered_map<std::string, std::deque<std::int64_t>>;

TimesByContent times_of(const std::vector<Stamped>& frames) {
  TimesByContent times;
  for (const Stamped& one : frames) times[content_of(one.frame)].push_back(one.t_ns);
  return times;
}

// The clock of log b minus the clock of log a: the median over the frames that occur once in each log. If
// there are no such frames, the difference between the stamps of the two first frames.
std::int64_t clocks_apart_ns(const std::vector<Stamped>& a, const std::vector<Stamped>& b) {
  const TimesByContent of_b = times_of(b);
  std::vector<std::int64_t> apart_ns;
  for (const auto& [content, times] : times_of(a)) {
    const auto found = of_b.find(content);
    if (times.size() == 1 && found != of_b.end() && found->second.size() == 1)
      apart_ns.push_back(found->second.front() - times.front());
  }
  if (apart_ns.empty()) return b.front().t_ns - a.front().t_ns;
  const auto middle = apart_ns.begin() + static_cast<std::ptrdiff_t>(apart_ns.size() / 2);
  std::ranges::nth_element(apart_ns, middle);
  return *middle;
}

// Updates count, mean and the sum of squared deviations with each difference (Welford's algorithm).
class Collected {
 public:
  void add(double difference_s) {
    ++of_.count;
    const double off_s = difference_s - of_.mean_s;
    of_.mean_s += off_s / static_cast<double>(of_.count);
    squares_ += off_s * (difference_s - of_.mean_s);
    of_.min_s = of_.count == 1 ? difference_s : std::min(of_.min_s, difference_s);
    of_.max_s = of_.count == 1 ? difference_s : std::max(of_.max_s, difference_s);
  }
  void add_only(bool in_a) { ++(in_a ? of_.only_in_a : of_.only_in_b); }
  [[nodiscard]] StampDifference result(std::uint32_t id, bool extended) const {
    StampDifference all = of_;
    all.id = id;
    all.extended = extended;
    if (all.count > 1) all.sd_s = std::sqrt(squares_ / static_cast<double>(all.count - 1));
    return all;
  }

 private:
  StampDifference of_;
  double squares_ = 0;
};

}  // namespace

Result<StampsCompared> compare_stamps(const std::string& log_a, const std::string& log_b) {
  StampsCompared compared;
  const auto a = read_all(log_a);
  if (!a) return tl::unexpected(a.error());
  const auto b = read_all(log_b);
  if (!b) return tl::unexpected(b.error());

  std::map<std::pair<std::uint32_t, bool>, Collected> messages;
  Collected all;
  const auto add_only = [&](const Frame& frame, bool in_a) {
    messages[{frame.id, frame.extended}].add_only(in_a);
    all.add_only(in_a);
  };
  std::int64_t apart_ns = clocks_apart_ns(*a, *b);
  const std::int64_t from_ns = std::max(a->front().t_ns + apart_ns, b->front().t_ns) - most_apart_ns;
  const std::int64_t to_ns = std::min(a->back().t_ns + apart_ns, b->back().t_ns) + most_apart_ns;
  TimesByContent waiting = times_of(*b);
  std::unordered_map<std::string, std::deque<std::int64_t>>
      paired;  // stamps in b of the frames that are also in a; key: content
  for (const Stamped& one : *a) {
    const std::string content = content_of(one.frame);
    std::deque<std::int64_t>& times = waiting[content];
    const std::int64_t expected_ns = one.t_ns + apart_ns;
    const auto off = [&](std::int64_t t_ns) { return std::abs(t_ns - expected_ns); };
    while (!times.empty() && times.front() < expected_ns - most_apart_ns) times.pop_front();
    while (times.size() > 1 && off(times[1]) < off(times[0])) times.pop_front();
    if (times.empty() || off(times.front()) > most_apart_ns) {
      if (expected_ns < from_ns || expected_ns > to_ns)
        ++compared.outside;
      else
        add_only(one.frame, true);
      continue;
    }
    const std::int64_t difference_ns = times.front() - one.t_ns;
    paired[content].push_back(times.front());
    times.pop_front();
    messages[{one.frame.id, one.frame.extended}].add(1e-9 * static_cast<double>(difference_ns));
    all.add(1e-9 * static_cast<double>(difference_ns));
    apart_ns += (difference_ns - apart_ns) / drift_over;
  }
  for (const Stamped& one : *b) {
    std::deque<std::int64_t>& times = paired[content_of(one.frame)];
    if (!times.empty() && times.front() == one.t_ns)
      times.pop_front();
    else if (one.t_ns < from_ns || one.t_ns > to_ns)
      ++compared.outside;
    else
      add_only(one.frame, false);
  }
  for (const auto& [key, collected] : messages)
    compared.messages.push_back(collected.result(key.first, key.second));
  compared.all = all.result(0, false);
  return compared;
}

std::string to_text(const StampsCompared& compared, const MessageName& name) {
  std::string text =
      fmt::format("{:<24} {:>8} {:>12} {:>10} {:>12} {:>12} {:>9} {:>9}\n", "stamp of b less a [us]", "count",
                  "mean", "sd", "min", "max", "only in a", "only in b");
  const auto add = [&](const std::string& what, const StampDifference& one) {
    text += fmt::format("{:<24} {:>8}", what, one.count);
    if (one.count == 0)
      text += fmt::format(" {:>12} {:>10} {:>12} {:>12}", "-", "-", "-", "-");
    else
      text += fmt::format(" {:>12.1f} {:>10.1f} {:>12.1f} {:>12.1f}", one.mean_s * 1e6, one.sd_s * 1e6,
                          one.min_s * 1e6, one.max_s * 1e6);
    text += fmt::format(" {:>9} {:>9}\n", one.only_in_a, one.only_in_b);
  };
  for (const StampDifference& one : compared.messages) {
    const std::string known = name(one);
    add(known.empty() ? fmt::format("{:0{}X}", one.id, one.extended ? 8 : 3) : known, one);
  }
  add("all", compared.all);
  if (compared.outside > 0)
    text += fmt::format("{} frames were recorded while the other log did not record\n", compared.outside);
  return text;
}

std::string to_json(const StampsCompared& compared, const MessageName& name) {
  const auto object = [](const StampDifference& one) {
    Json json{{"count", one.count}};
    if (one.count > 0)
      json.update({{"mean_s", one.mean_s}, {"sd_s", one.sd_s}, {"min_s", one.min_s}, {"max_s", one.max_s}});
    json.update({{"only_in_a", one.only_in_a}, {"only_in_b", one.only_in_b}});
    return json;
  };
  Json json{{"messages", Json::array()}};
  for (const StampDifference& one : compared.messages) {
    Json message{{"id", one.id}, {"extended", one.extended}, {"name", name(one)}};
    message.update(object(one));
    json["messages"].push_back(std::move(message));
  }
  json["all"] = object(compared.all);
  json["outside"] = compared.outside;
  return json.dump(2) + "\n";
}

}  // namespace canhil::recordings
