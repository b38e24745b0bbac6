// Reads frames "ID#HEXDATA" (id as in the text of the DBC, hexadecimal), one per line, and prints their
// values as JSON. With --encode it prints
// {"values": values, "bytes": the values encoded again}. The DBC is read leniently.
#include <fmt/format.h>

#include <cstdint>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/parser/parse.hpp"
#include "dbc/parser/plan.hpp"

namespace {

using canhil::dbc::Message;
using canhil::dbc::MessagePlan;

struct Planned {
  const Message* message;
  MessagePlan plan;
};
using Plans = std::map<std::uint32_t, Planned>;  // by id; bit 31 marks an extended id

std::vector<std::uint8_t> bytes_of(const std::string& hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

nlohmann::json values_json(const Planned& planned, const std::vector<std::uint8_t>& data,
                           const std::vector<double>& values) {
  nlohmann::json json = nlohmann::json::object();
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Values are printed as text, because JSON has neither nan nor inf.
    if (planned.plan.is_present(i, data))
      json[planned.message->signals[i].name] = fmt::format("{}", values[i]);
  }
  return json;
}

nlohmann::json decoded(const Plans& plans, const std::string& line, bool encode) {
  const auto separator = line.find('#');
  const auto id = static_cast<std::uint32_t>(std::stoul(line.substr(0, separator), nullptr, 16));
  const auto planned = plans.find(id);
  if (planned == plans.end()) return nullptr;
  std::vector<std::uint8_t> data = bytes_of(line.substr(separator + 1));
  const MessagePlan& plan = planned->second.plan;
  std::vector<double> values(plan.signals());
  if (data.size() != plan.size() || !plan.decode(data, values))
    return fmt::format("{} bytes, expected {}", data.size(), plan.size());
  nlohmann::json json = values_json(planned->second, data, values);
  if (!encode) return json;
  if (!plan.encode(values, data)) return "cannot be encoded";
  return {{"values", json}, {"bytes", fmt::format("{:02x}", fmt::join(data, ""))}};
}

}  // namespace

int main(int argc, char** argv) {
  const bool encode = argc > 2 && argv[1] == std::string_view("--encode");
  const auto database = canhil::dbc::read_file_leniently(argc > 1 ? argv[argc - 1] : "");
  if (!database) {
    fmt::print(stderr, "{}\n", database.error().message);
    return 2;
  }
  Plans plans;
  for (const Message& message : database->messages) {
    const std::uint32_t id = message.id | (message.extended ? 0x8000'0000U : 0U);
    plans.emplace(id, Planned{&message, MessagePlan(message)});
  }
  for (std::string line; std::getline(std::cin, line);)
    fmt::print("{}\n", decoded(plans, line, encode).dump());
}
