#include "dbc/codegen/load.hpp"

#include <fmt/format.h>

#include <map>

#include "dbc/wire/bit_length.hpp"

namespace canhil::dbc {

std::string load_table(const Database& database) {
  struct Load {
    int cyclic = 0;
    int left_out = 0;
    double bits_per_s = 0;
  };
  std::map<std::string, Load> loads;
  for (const Message& message : database.messages) {
    Load& load = loads[message.sender.empty() ? "(nobody)" : message.sender];
    if (message.cycle_time_us == 0 || message.fd) {
      ++load.left_out;
      continue;
    }
    ++load.cyclic;
    load.bits_per_s += static_cast<double>(wire::worst_case_length(message.size, message.extended).bits()) *
                       1e6 / static_cast<double>(message.cycle_time_us);
  }
  const AttributeValue* rate = find_attribute(database, database.attributes, Owner::network, "Baudrate");
  const auto* given = rate != nullptr ? std::get_if<std::int64_t>(rate) : nullptr;
  const double bit_rate = given != nullptr && *given > 0 ? static_cast<double>(*given) : 500'000;
  std::string text =
      fmt::format("{:<16} {:>8} {:>12} {:>10} {:>8}\n", "sender", "cyclic", "event or FD", "bit/s", "load");
  Load sum;
  for (const auto& [sender, load] : loads) {
    text += fmt::format("{:<16} {:>8} {:>12} {:>10.0f} {:>7.2f}%\n", sender, load.cyclic, load.left_out,
                        load.bits_per_s, 100 * load.bits_per_s / bit_rate);
    sum = {sum.cyclic + load.cyclic, sum.left_out + load.left_out, sum.bits_per_s + load.bits_per_s};
  }
  return text + fmt::format("{:<16} {:>8} {:>12} {:>10.0f} {:>7.2f}% of {:.0f} bit/s\n", "all", sum.cyclic,
                            sum.left_out, sum.bits_per_s, 100 * sum.bits_per_s / bit_rate, bit_rate);
}

}  // namespace canhil::dbc
