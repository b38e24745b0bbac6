#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "dbc/logs/asc.hpp"
#include "dbc/logs/formats.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::logs {
namespace {

// The date in local time, because the format has no time zone.
std::string date(std::int64_t s) { return fmt::format("{:%a %b %d %H:%M:%S %Y}", fmt::localtime(s)); }

std::string id_of(const Frame& frame) { return fmt::format("{:X}{}", frame.id, frame.extended ? "x" : ""); }

std::string bytes_of(const Frame& frame) {
  std::string text;
  for (const std::uint8_t byte : frame.payload()) text += fmt::format(" {:02X}", byte);
  return text;
}

class AscSink final : public LogSink {
 public:
  explicit AscSink(File file) : lines_(std::move(file)) {}

  void write(const LogEntry& entry) override {
    if (!begun_) begin(entry.t_ns);
    const std::size_t channel = channel_of(entry.interface);
    const Frame& frame = entry.frame;
    // The log starts at the full second of the first frame. The format cannot express earlier times, so a
    // frame with an earlier stamp gets the time 0.
    const std::int64_t since_us = std::max<std::int64_t>(entry.t_ns - start_s_ * ns_per_s, 0) / 1000;
    std::string line = fmt::format("{:4}.{:06} ", since_us / 1'000'000, since_us % 1'000'000);
    const std::string_view direction = entry.transmitted ? "Tx" : "Rx";
    if (frame.error) {
      line += fmt::format("{}  ErrorFrame", channel);
    } else if (frame.fd) {
      const std::uint32_t flags =
          AscFdFlags::fd | (frame.brs ? AscFdFlags::brs : 0) | (frame.esi ? AscFdFlags::esi : 0);
      line += fmt::format(
          "CANFD {:>3} {:<4} {:>8}  {:>32} {} {} {:x} {:>2}{} {:>8} {:>4} {:>8X} {:>8} {:>8} {:>8} {:>8} "
          "{:>8}",
          channel, direction, id_of(frame), "", frame.brs ? 1 : 0, frame.esi ? 1 : 0, dlc_of(frame.size),
          frame.size, bytes_of(frame), 0, 0, flags, 0, 0, 0, 0, 0);
    } else if (entry.remote) {
      line += fmt::format("{}  {:<15} {:<4} r {:x}", channel, id_of(frame), direction, frame.size);
    } else {
      line += fmt::format("{}  {:<15} {:<4} d {:x}{}", channel, id_of(frame), direction, frame.size,
                          bytes_of(frame));
    }
    lines_.write(line + "\n");
  }
  int close() override {
    if (!begun_) begin(0);
    lines_.write("End TriggerBlock\n");
    return lines_.close();
  }

 private:
  void begin(std::int64_t t_ns) {
    begun_ = true;
    start_s_ = t_ns / ns_per_s;
    lines_.write(fmt::format(
        "date {0}\nbase hex  timestamps absolute\ninternal events logged\nBegin Triggerblock {0}\n"
        "   0.000000 Start of measurement\n",
        date(start_s_)));
  }
  std::size_t channel_of(const std::string& interface) {
    const auto found = std::ranges::find(interfaces_, interface);
    const auto index = static_cast<std::size_t>(found - interfaces_.begin());
    if (found == interfaces_.end()) {
      interfaces_.push_back(interface);
      lines_.write(fmt::format("// channel {}: {}\n", index + 1, interface));
    }
    return index + 1;
  }

  LineWriter lines_;
  bool begun_ = false;
  std::int64_t start_s_ = 0;
  std::vector<std::string> interfaces_;
};

}  // namespace

std::unique_ptr<LogSink> asc_sink(File file) { return std::make_unique<AscSink>(std::move(file)); }

}  // namespace canhil::logs
