// Any text: the parser ends, with a Database or with one line that says where.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "dbc/parser/parse.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto database = canhil::dbc::parse(text, "fuzz.dbc");
  if (!database) {
    const std::string& message = database.error().message;
    if (!message.starts_with("fuzz.dbc:") || message.find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
