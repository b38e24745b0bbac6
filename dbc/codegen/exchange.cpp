#include "dbc/codegen/exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "dbc/parser/parse.hpp"

namespace canhil::dbc {
namespace {

std::string text_of(const Message& message, const Signal& signal) {
  std::string text =
      fmt::format("{} {} {} {} {} {:a} {:a} {} {}", signal.name, signal.start_bit, signal.length,
                  static_cast<int>(signal.byte_order), static_cast<int>(signal.type), signal.scale,
                  signal.offset, signal.multiplexor, signal.multiplexed_by);
  for (const MuxRange& range : signal.mux_ranges) text += fmt::format(" {}-{}", range.first, range.last);
  if (message.estimators.empty()) return text + "\n";
  auto values = signal.values;
  std::ranges::sort(values, {}, &ValueName::value);
  for (const ValueName& value : values) text += fmt::format(" {}={}", value.value, value.name);
  return text + "\n";
}

std::string text_of(const Message& message) {
  std::string text = fmt::format("{} {:x} {} {} {} {} {} {} {}\n", message.name, message.id, message.extended,
                                 message.fd, message.size, message.e2e_data_id, message.cycle_time_us,
                                 message.sample_group, fmt::join(message.answers, ","));
  for (const Signal& signal : message.signals) text += text_of(message, signal);
  return text;
}

std::uint32_t hash24_of(const Database& database, const std::string& estimator) {
  std::vector<const Message*> exchanged;
  for (const Message& message : database.messages) {
    const auto& users = message.estimators;
    if (users.empty() || std::ranges::find(users, estimator) != users.end()) exchanged.push_back(&message);
  }
  std::ranges::sort(exchanged, {}, [](const Message* one) { return std::pair(one->id, one->extended); });
  std::string text;
  for (const Message* message : exchanged) text += text_of(*message);
  return fold24(hash(text));
}

}  // namespace

std::vector<Exchange> exchanges(const Database& database) {
  std::set<std::string> estimators{""};
  for (const Message& message : database.messages)
    estimators.insert(message.estimators.begin(), message.estimators.end());
  std::vector<Exchange> all;
  for (const std::string& estimator : estimators)
    all.push_back({.estimator = estimator, .hash24 = hash24_of(database, estimator)});
  return all;
}

}  // namespace canhil::dbc
