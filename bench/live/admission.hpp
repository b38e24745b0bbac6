// Which requests are answered: the rules of the page's server, apart from its sockets.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace canhil::live {

struct Admission {
  std::string address;  ///< that the server listens on
  bool loopback = true;
  std::uint16_t port = 0;
  std::string token{};  ///< that a URL has to carry; empty: none

  [[nodiscard]] std::string query() const { return token.empty() ? "" : "?token=" + token; }
  [[nodiscard]] std::string url() const;
};

/// A request. Fields that were not sent are empty.
struct Asked {
  std::string_view method, target, host, origin;
  bool upgrade = false;  ///< to a WebSocket
};

struct Answer {
  unsigned status = 200;
  std::string_view what{};  ///< status 200: the requested path; otherwise the reason
};

/// The name of the WebSocket's resource.
inline constexpr std::string_view socket_path = "/live";

/// Decides whether to answer a request. A page of another site in the same browser can make the browser send
/// requests here, even under its own host name (DNS rebinding). It cannot choose the origin that the browser
/// states, so that origin is checked.
Answer admit(const Admission& admission, const Asked& asked);

/// 128 random bits in hexadecimal.
std::string new_token();

}  // namespace canhil::live
