#include "dbc/codegen/exact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dbc/codegen/names.hpp"
#include "dbc/parser/parse.hpp"

namespace canhil::dbc {
namespace {

constexpr std::array fd_sizes{8U, 12U, 16U, 20U, 24U, 32U, 48U, 64U};

/// True for signals whose member is a double. A multiplexor stays: its raw value decides what follows.
bool is_rounded(const Signal& signal) { return !is_plain(signal) && !signal.multiplexor; }

void carry_as_double(Signal& signal) {
  signal.type = RawType::float64;
  signal.length = 64;
  signal.scale = 1;
  signal.offset = 0;
  signal.values.clear();  // names of raw values, which the twin does not have
}

/// Lays the signals out in the order of the DBC; the bits that they take, from the start of the message.
unsigned lay_out(Message& message) {
  unsigned next = message.e2e_data_id != 0 ? 12 : 0;  // behind the CRC and the counter
  for (Signal& signal : message.signals) {
    if (is_protection(message, signal)) continue;
    if (is_rounded(signal)) {
      carry_as_double(signal);
      next = (next + 7) / 8 * 8;
    }
    signal.byte_order = ByteOrder::little_endian;
    signal.start_bit = next;
    next += signal.length;
  }
  return next;
}

}  // namespace

Result<Database> exact(const Database& database, std::string_view dbc_name) {
  Database twin = database;
  for (Message& message : twin.messages) {
    if (std::ranges::none_of(message.signals, is_rounded)) continue;
    const unsigned bytes = (lay_out(message) + 7) / 8;
    const auto size = std::ranges::lower_bound(fd_sizes, bytes);
    if (size == fd_sizes.end()) {
      return failure(
          fmt::format("{}:{}:{}: message {} takes {} bytes with its scaled signals as 64-bit floats, "
                      "expected at most {}",
                      dbc_name, message.at.line, message.at.column, message.name, bytes, fd_sizes.back()));
    }
    message.size = *size;
    message.fd = true;
  }
  twin.hash = hash(fmt::format("{:016x} exact", database.hash));
  return twin;
}

}  // namespace canhil::dbc
