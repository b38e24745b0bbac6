#include "dbc/codegen/json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace canhil::dbc {
namespace {

using nlohmann::ordered_json;

ordered_json attributes_json(const Attributes& attributes) {
  ordered_json json = ordered_json::object();
  for (const auto& [name, value] : attributes) {
    std::visit([&, &key = name](const auto& v) { json[key] = v; }, value);
  }
  return json;
}

ordered_json values_json(const std::vector<ValueName>& values) {
  ordered_json json = ordered_json::object();
  for (const ValueName& value : values) json[fmt::to_string(value.value)] = value.name;
  return json;
}

ordered_json signal_json(const Signal& signal) {
  ordered_json ranges = ordered_json::array();
  for (const MuxRange& range : signal.mux_ranges) ranges.push_back({range.first, range.last});
  return {{"name", signal.name},
          {"start_bit", signal.start_bit},
          {"length", signal.length},
          {"big_endian", signal.byte_order == ByteOrder::big_endian},
          {"signed", signal.is_signed()},
          {"float", signal.is_float()},
          {"scale", signal.scale},
          {"offset", signal.offset},
          {"minimum", signal.minimum},
          {"maximum", signal.maximum},
          {"unit", signal.unit},
          {"receivers", signal.receivers},
          {"multiplexor", signal.multiplexor},
          {"multiplexed_by", signal.multiplexed_by},
          {"mux_ranges", ranges},
          {"values", values_json(signal.values)},
          {"comment", signal.comment},
          {"attributes", attributes_json(signal.attributes)}};
}

ordered_json message_json(const Message& message) {
  ordered_json signals = ordered_json::array();
  for (const Signal& signal : message.signals) signals.push_back(signal_json(signal));
  return {{"name", message.name},
          {"id", message.id},
          {"extended", message.extended},
          {"fd", message.fd},
          {"size", message.size},
          {"sender", message.sender},
          {"further_senders", message.further_senders},
          {"cycle_time_us", message.cycle_time_us},
          {"comment", message.comment},
          {"attributes", attributes_json(message.attributes)},
          {"signals", signals}};
}

}  // namespace

std::string to_json(const Database& database) {
  ordered_json json{{"version", database.version}, {"comment", database.comment}};
  for (const Node& node : database.nodes) {
    json["nodes"].push_back(
        {{"name", node.name}, {"comment", node.comment}, {"attributes", attributes_json(node.attributes)}});
  }
  for (const ValueTable& table : database.value_tables)
    json["value_tables"][table.name] = values_json(table.values);
  json["attributes"] = attributes_json(database.attributes);
  json["messages"] = ordered_json::array();
  for (const Message& message : database.messages) json["messages"].push_back(message_json(message));
  return json.dump(2);
}

std::string to_json(const Message& message) { return message_json(message).dump(2); }

}  // namespace canhil::dbc
