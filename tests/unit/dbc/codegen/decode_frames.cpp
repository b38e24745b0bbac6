// Reads frames "ID#HEXDATA" (id as in the DBC's text, hexadecimal), one a line, and prints what they hold as
// JSON.
#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "dbc/parser/codec.hpp"
#include "dbc/parser/parse.hpp"

namespace {

std::vector<std::uint8_t> bytes_of(const std::string& hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

nlohmann::json decoded(const canhil::dbc::Database& database, const std::string& line) {
  const auto separator = line.find('#');
  const auto id = static_cast<std::uint32_t>(std::stoul(line.substr(0, separator), nullptr, 16));
  const auto* message = canhil::dbc::find_message(database, id & 0x7FFF'FFFFU, (id >> 31U) != 0);
  if (message == nullptr) return nullptr;
  const auto signals = canhil::dbc::decode(*message, bytes_of(line.substr(separator + 1)));
  if (!signals) return signals.error().message;
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [signal, value] : *signals)
    json[signal->name] = fmt::format("{}", value);  // nan and inf too
  return json;
}

}  // namespace

int main(int argc, char** argv) {
  const auto database = canhil::dbc::read_file_leniently(argc > 1 ? argv[1] : "");
  if (!database) {
    fmt::print(stderr, "{}\n", database.error().message);
    return 2;
  }
  for (std::string line; std::getline(std::cin, line);) fmt::print("{}\n", decoded(*database, line).dump());
}
