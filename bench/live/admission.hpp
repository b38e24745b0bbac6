// Decides which requests the server of the page answers. This code uses no sockets.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace canhil::live {

struct Admission {
  std::string address;  ///< address or host name in the URL
  bool loopback = true;
  std::uint16_t port = 0;
  std::string token{};  ///< required in the URL; empty: no token is required

  [[nodiscard]] std::string query() const { return token.empty() ? "" : "?token=" + token; }
  [[nodiscard]] std::string url() const;
};

/// A request. Fields that were not sent are empty.
struct Asked {
  std::string_view method, target, host, origin;
  bool upgrade = false;  ///< the request upgrades to a WebSocket
};

struct Answer {
  unsigned status = 200;
  std::string_view what{};  ///< status 200: the requested path; otherwise the reason
};

/// The path of the WebSocket in its URL.
inline constexpr std::string_view socket_path = "/live";

/// Decides whether to answer a request. A page of another site, open in the same browser, can make the
/// browser send requests to this server, even under that site's host name (DNS rebinding). The page cannot
/// choose the origin that the browser states, so admit() checks the origin.
Answer admit(const Admission& admission, const Asked& asked);

/// 128 random bits in hexadecimal.
std::string new_token();

}  // namespace canhil::live
