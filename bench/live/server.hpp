// The page over HTTP and WebSocket. Boost.Beast does the work, behind this header.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bench/live/display.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::live {

/// What a browser can cost: so many connections, of which each has one message on its way at the most; who is
/// slower misses those between. Whoever takes none for ten seconds is dropped.
inline constexpr std::size_t most_connections = 16;
inline constexpr std::uint16_t usual_port = 8460;
inline constexpr const char* loopback_address = "127.0.0.1";

/// Port 0: any that is free. An address other than the loopback's has a token in its URL. Error: one line; no
/// address of this machine, or the port is in use.
class Server : public Display {
 public:
  static Result<std::unique_ptr<Server>> open(const std::string& address, std::uint16_t port);
  /// Of the page.
  [[nodiscard]] virtual std::string url() const = 0;
};

}  // namespace canhil::live
