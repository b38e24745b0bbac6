#include "dbc/transport/uds.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace canhil::transport {
namespace {

constexpr std::uint8_t negative_response = 0x7F;

constexpr std::array<std::pair<std::uint8_t, std::string_view>, 18> names{
    {{0x10, "general reject"},
     {0x11, "service not supported"},
     {0x12, "sub-function not supported"},
     {0x13, "incorrect message length or invalid format"},
     {0x14, "response too long"},
     {0x21, "busy, repeat request"},
     {0x22, "conditions not correct"},
     {0x24, "request sequence error"},
     {0x31, "request out of range"},
     {0x33, "security access denied"},
     {0x35, "invalid key"},
     {0x36, "exceeded number of attempts"},
     {0x37, "required time delay not expired"},
     {0x70, "upload or download not accepted"},
     {0x72, "general programming failure"},
     {response_pending, "response pending"},
     {0x7E, "sub-function not supported in active session"},
     {0x7F, "service not supported in active session"}}};

}  // namespace

std::optional<std::uint8_t> negative_code(std::span<const std::uint8_t> request,
                                          std::span<const std::uint8_t> answer) {
  if (answer.size() != 3 || answer[0] != negative_response || request.empty() || answer[1] != request[0])
    return std::nullopt;
  return answer[2];
}

std::string_view name_of_negative_code(std::uint8_t code) {
  const auto found = std::ranges::find(names, code, &std::pair<std::uint8_t, std::string_view>::first);
  return found == names.end() ? std::string_view() : found->second;
}

}  // namespace canhil::transport
