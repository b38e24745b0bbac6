#include "dbc/ports/wire_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "dbc/ports/bit_errors.hpp"

namespace canhil {
namespace {

/// Removes the text before the first `mark`, and the mark itself, and returns the removed text without the
/// mark. If there is no mark, removes and returns all text.
std::string_view cut(std::string_view& text, char mark) {
  const std::size_t at = std::min(text.find(mark), text.size());
  const std::string_view head = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return head;
}

template <class Number>
bool read_number(std::string_view digits, Number lowest, Number highest, Number& number) {
  const char* end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, number);
  return read.ec == std::errc{} && read.ptr == end && number >= lowest && number <= highest;
}

/// Applies a setting `key=value`; false: the setting is not valid.
bool read_setting(std::string_view setting, WireSettings& into) {
  const std::string_view key = cut(setting, '=');
  if (key == "bitrate") return read_number<std::int64_t>(setting, 1'000, 1'000'000, into.rates.nominal);
  if (key == "data-bitrate") return read_number<std::int64_t>(setting, 1'000, 20'000'000, into.rates.data);
  if (key == "bit-error-rate") return read_number(setting, 0.0, 1.0, into.bit_error_rate);
  if (key == "seed") return read_number<std::uint64_t>(setting, 0, ~std::uint64_t{0}, into.seed);
  into.order = setting == "priority" ? QueueOrder::priority : QueueOrder::fifo;
  return key == "queue" && (setting == "priority" || setting == "fifo");
}

}  // namespace

Result<WireSettings> wire_settings(std::string_view bus) {
  WireSettings result;
  std::string_view rest = bus;
  cut(rest, '?');
  std::set<std::string_view> given;
  bool more = !rest.empty();
  while (more) {
    more = rest.find('&') != std::string_view::npos;  // another setting must follow after a '&'
    const std::string_view setting = cut(rest, '&');
    if (!read_setting(setting, result)) {
      return failure(
          fmt::format("'{}': '{}' is not understood, expected bitrate=1000..1000000, "
                      "data-bitrate=1000..20000000, queue=fifo|priority, bit-error-rate=0..1 or "
                      "seed=0..18446744073709551615",
                      bus, setting));
    }
    const std::string_view key = setting.substr(0, setting.find('='));
    if (!given.insert(key).second)
      return failure(fmt::format("'{}': '{}' is given twice, expected it once", bus, key));
  }
  if (result.rates.nominal == 0 && bus.find('?') != std::string_view::npos)
    return failure(fmt::format("'{}': expected bitrate=1000..1000000 after '?'", bus));
  if (result.rates.data > 0 && result.rates.data < result.rates.nominal)
    return failure(fmt::format("'{}': data-bitrate={} is slower than bitrate={}, expected at least that", bus,
                               result.rates.data, result.rates.nominal));
  return result;
}

Disturb disturbance(const WireSettings& settings) {
  if (settings.bit_error_rate == 0) return {};
  return BitErrors(settings.bit_error_rate, settings.rates, settings.seed);
}

}  // namespace canhil
