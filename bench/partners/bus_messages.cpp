#include "bench/partners/bus_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "bench/scenario/nearest.hpp"
#include "dbc/parser/codec.hpp"

namespace canhil::partners {

BusMessages::BusMessages(const scenario::Binding& binding) {
  for (const dbc::Database* database : binding.databases()) {
    for (const dbc::Message& message : database->messages) {
      if (message.size > Frame::max_size || message.j1939_transport()) continue;
      Own own{.message = &message};
      const auto info = std::ranges::find_if(
          binding.messages, [&](const MessageInfo& one) { return one.name == message.name; });
      if (info != binding.messages.end()) own.protection = binding.protection_of(*info);
      by_name_.emplace(message.name, std::move(own));
      by_id_.emplace(std::pair(message.id, message.extended), &message);
    }
  }
}

const dbc::Message* BusMessages::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : found->second.message;
}

std::string BusMessages::instead_of(std::string_view name) const {
  std::vector<std::string> names;
  for (const auto& [known, own] : by_name_) names.emplace_back(known);
  const std::string meant = scenario::nearest(name, names);
  return meant.empty() ? "a message of the DBC" : fmt::format("'{}'", meant);
}

const dbc::Message* BusMessages::of(const Frame& frame) const {
  const auto found = by_id_.find(std::pair(frame.id, frame.extended));
  return found == by_id_.end() || frame.error ? nullptr : found->second;
}

std::optional<std::string> BusMessages::text(const dbc::Message& message, const Frame& frame) {
  const auto decoded = dbc::decode(message, frame.payload());
  if (!decoded) return std::nullopt;
  std::string text = message.name;
  for (const dbc::DecodedSignal& one : *decoded)
    fmt::format_to(std::back_inserter(text), " {}={}", one.signal->name, one.value);
  return text;
}

Result<Frame> BusMessages::frame(std::string_view name,
                                 std::span<const std::pair<std::string_view, double>> values) {
  const auto found = by_name_.find(name);
  if (found == by_name_.end())
    return failure(fmt::format("message '{}' is unknown, expected {}", name, instead_of(name)));
  Own& own = found->second;
  const dbc::Message& message = *own.message;
  for (const auto& [signal, value] : values) {
    if (std::ranges::find(message.signals, signal, &dbc::Signal::name) == message.signals.end())
      return failure(fmt::format("message '{}' has no signal '{}'", name, signal));
    own.values.insert_or_assign(std::string(signal), value);
  }
  std::vector<dbc::NamedValue> named;
  for (const auto& [signal, value] : own.values) named.push_back({.signal = signal, .value = value});
  auto bytes = dbc::encode(message, named);
  if (!bytes) return tl::unexpected(bytes.error());
  if (own.protection) own.counter.protect(*own.protection, *bytes);
  Frame frame{.id = message.id,
              .size = static_cast<std::uint8_t>(bytes->size()),
              .extended = message.extended,
              .fd = message.fd};
  std::ranges::copy(*bytes, frame.data.begin());
  return frame;
}

}  // namespace canhil::partners
