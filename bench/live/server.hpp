// Serves the page over HTTP and WebSocket; the implementation uses Boost.Beast.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bench/live/display.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::live {

/// The number of connections is limited, and each connection has at most one message in transit. This limits
/// the load that browsers cause. A slow browser misses snapshots. A browser that accepts no data for ten
/// seconds is disconnected.
inline constexpr std::size_t most_connections = 16;
inline constexpr std::uint16_t usual_port = 8460;
inline constexpr const char* loopback_address = "127.0.0.1";

/// Opens the page. Port 0: any free port. On an address other than loopback, the URL contains a token.
/// Returns an Error of one line if the address does not belong to this machine or the port is in use.
class Server : public Display {
 public:
  static Result<std::unique_ptr<Server>> open(const std::string& address, std::uint16_t port);
  /// The URL of the page.
  [[nodiscard]] virtual std::string url() const = 0;
};

}  // namespace canhil::live
