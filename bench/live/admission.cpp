#include "bench/live/admission.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace canhil::live {
namespace {

// Compares in a time that is independent of the position of the first difference.
bool same(std::string_view a, std::string_view b) {
  unsigned differing = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    differing |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return differing == 0;
}

std::string in_url(const std::string& address) {
  return address.find(':') == std::string::npos ? address : '[' + address + ']';
}

bool is_host_here(const Admission& admission, std::string_view host) {
  const std::array<std::string, 3> names{"localhost", "127.0.0.1", "[::1]"};
  return host == fmt::format("{}:{}", in_url(admission.address), admission.port) ||
         std::ranges::any_of(names, [&](const std::string& name) {
           return host == fmt::format("{}:{}", name, admission.port);
         });
}

}  // namespace

std::string Admission::url() const { return fmt::format("http://{}:{}/{}", in_url(address), port, query()); }

Answer admit(const Admission& admission, const Asked& asked) {
  if (asked.method != "GET") return {405, "expected GET"};
  if (asked.host.empty()) return {400, "expected a Host"};
  if (admission.loopback && !is_host_here(admission, asked.host)) return {421, "this is not that host"};
  if (!asked.origin.empty() && asked.origin != fmt::format("http://{}", asked.host))
    return {403, "pages of other sites are not answered"};
  const std::size_t mark = asked.target.find('?');
  const std::string_view path = asked.target.substr(0, mark);
  const std::string_view query = mark == std::string_view::npos ? "" : asked.target.substr(mark);
  if (!admission.token.empty() && !same(query, admission.query()))
    return {403, "expected the token of the URL that hil-bench printed"};
  if (path == socket_path && !asked.upgrade) return {426, "expected a WebSocket"};
  if (path != socket_path && asked.upgrade) return {404, "there is no such WebSocket"};
  return {200, path};
}

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("no random numbers for a token");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

}  // namespace canhil::live
