#include "bench/live/server.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bench/live/admission.hpp"
#include "bench/live/message.hpp"
#include "bench/live/page.hpp"

namespace canhil::live {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;
using namespace std::chrono_literals;

constexpr std::size_t most_request_bytes = 8192;
constexpr auto request_time = 5s, answer_time = 10s, slowest_message = 10s;

using Text = std::shared_ptr<const std::string>;

// Child processes must not inherit the port or a connection.
template <class Socket>
void close_on_exec(Socket& socket) {
  fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
}

struct File {
  std::string_view path, type, text;
};

std::string_view text_of(const EmbeddedFiles& files, std::string_view name) {
  return std::ranges::find(files, name, &EmbeddedFile::name)->text;
}

// The page, with the token inserted into each address to which the page refers.
std::string page_with(const std::string& query) {
  constexpr std::string_view mark = "$QUERY";
  std::string page(text_of(page_texts, "page"));
  for (std::size_t at = page.find(mark); at != std::string::npos; at = page.find(mark, at + query.size()))
    page.replace(at, mark.size(), query);
  return page;
}

// State that the server's connections share.
struct Site {
  Admission admission;
  std::string page;
  std::vector<File> files;
  std::size_t connections = 0;
};

// Counts a connection during its lifetime.
class Place {
 public:
  explicit Place(Site& site) : site_(&site) { ++site.connections; }
  Place(Place&& other) noexcept : site_(std::exchange(other.site_, nullptr)) {}
  Place& operator=(Place&&) = delete;
  ~Place() {
    if (site_ != nullptr) --site_->connections;
  }

 private:
  Site* site_;
};

// A connected browser. The server sends one message at a time; a browser misses the snapshots that come in
// the meantime.
class Spectator : public std::enable_shared_from_this<Spectator> {
 public:
  Spectator(tcp::socket socket, Place place) : place_(std::move(place)), stream_(std::move(socket)) {}

  void accept(const http::request<http::empty_body>& request, const std::function<void()>& accepted) {
    auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeout.handshake_timeout = request_time;
    timeout.idle_timeout = 20s;
    stream_.set_option(timeout);
    stream_.read_message_max(256);
    stream_.async_accept(request, [self = shared_from_this(), accepted](error_code error) {
      if (error) return;
      self->open_ = true;
      self->read();
      accepted();
    });
  }

  [[nodiscard]] bool open() const { return open_; }
  [[nodiscard]] bool busy() const { return message_ != nullptr; }
  [[nodiscard]] bool follows() const { return follows_; }  // no snapshot was skipped since the last message

  void send(Text message) {
    message_ = std::move(message);
    began_ = std::chrono::steady_clock::now();
    follows_ = true;
    stream_.text(true);
    stream_.async_write(asio::buffer(*message_), [self = shared_from_this()](error_code error, std::size_t) {
      self->message_.reset();
      if (error) self->open_ = false;
    });
  }
  // Called in place of send() while the browser is still receiving the previous message.
  void skip() {
    follows_ = false;
    if (std::chrono::steady_clock::now() - began_ > slowest_message) drop();
  }

 private:
  // The page never sends data on the WebSocket. A client that sends data is not our page and is disconnected.
  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      static_cast<void>(error);
      self->drop();
    });
  }
  void drop() {
    open_ = false;
    beast::get_lowest_layer(stream_).cancel();
    beast::get_lowest_layer(stream_).close();
  }

  Place place_;
  websocket::stream<beast::tcp_stream> stream_;
  beast::flat_buffer buffer_{512};
  Text message_;
  std::chrono::steady_clock::time_point began_{};
  bool open_ = false, follows_ = false;
};

// Handles one HTTP request.
class Exchange : public std::enable_shared_from_this<Exchange> {
 public:
  using Look = std::function<void(std::shared_ptr<Spectator>)>;
  Exchange(Site& site, tcp::socket socket, Look look)
      : site_(site), place_(site), stream_(std::move(socket)), look_(std::move(look)) {}

  void start() {
    parser_.header_limit(most_request_bytes);
    parser_.body_limit(0);
    stream_.expires_after(request_time);
    http::async_read(stream_, buffer_, parser_, [self = shared_from_this()](error_code error, std::size_t) {
      if (!error) return self->answer();
      if (error.category() == http::make_error_code(http::error::bad_method).category() &&
          error != http::error::end_of_stream)
        self->answer(400, "expected a request of at most 8 KiB, without a body", "text/plain");
    });
  }

 private:
  void answer() {
    const auto& request = parser_.get();
    const auto field = [&](http::field name) {
      return std::string_view(request[name].data(), request[name].size());
    };
    const bool upgrade = websocket::is_upgrade(request);
    const Answer answer =
        admit(site_.admission, {.method = {request.method_string().data(), request.method_string().size()},
                                .target = {request.target().data(), request.target().size()},
                                .host = field(http::field::host),
                                .origin = field(http::field::origin),
                                .upgrade = upgrade});
    if (answer.status != 200) return this->answer(answer.status, answer.what, "text/plain");
    if (upgrade) {
      stream_.expires_never();
      auto spectator = std::make_shared<Spectator>(stream_.release_socket(), std::move(place_));
      spectator->accept(request, [self = shared_from_this(), spectator] { self->look_(spectator); });
      return;
    }
    const auto file = std::ranges::find(site_.files, answer.what, &File::path);
    if (file == site_.files.end()) return this->answer(404, "there is no such page", "text/plain");
    this->answer(200, file->text, file->type);
  }

  void answer(unsigned status, std::string_view text, std::string_view type) {
    response_.result(status);
    response_.version(11);
    response_.keep_alive(false);
    response_.set(http::field::content_type, {type.data(), type.size()});
    response_.set(http::field::cache_control, "no-store");
    response_.set("Content-Security-Policy",
                  "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
                  "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.body() = {text.data(), text.size()};
    response_.prepare_payload();
    stream_.expires_after(answer_time);
    http::async_write(stream_, response_, [self = shared_from_this()](error_code, std::size_t) {
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  Site& site_;
  Place place_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{most_request_bytes};
  http::request_parser<http::empty_body> parser_;
  http::response<http::span_body<const char>> response_;
  Look look_;
};

class BeastServer final : public Server {
 public:
  BeastServer(const tcp::endpoint& endpoint, std::string token) : acceptor_(io_) {
    acceptor_.open(endpoint.protocol());
    close_on_exec(acceptor_);
    acceptor_.set_option(asio::socket_base::reuse_address(true));
    acceptor_.bind(endpoint);
    acceptor_.listen();
    const tcp::endpoint local = acceptor_.local_endpoint();
    // If the server listens on every address of the machine, remote browsers need the host name.
    site_.admission = {
        .address = local.address().is_unspecified() ? asio::ip::host_name() : local.address().to_string(),
        .loopback = local.address().is_loopback(),
        .port = local.port(),
        .token = std::move(token)};
    site_.page = page_with(site_.admission.query());
    site_.files = {{"/", "text/html; charset=utf-8", site_.page},
                   {"/style.css", "text/css; charset=utf-8", text_of(page_texts, "style")},
                   {"/script.js", "text/javascript; charset=utf-8", text_of(page_texts, "script")},
                   {"/chart.js", "text/javascript; charset=utf-8", text_of(library::chart_texts, "chart")}};
    accept();
  }

  [[nodiscard]] std::string url() const override { return site_.admission.url(); }
  void run_for(std::chrono::milliseconds time) override {
    io_.restart();
    io_.run_for(time);
  }

  void show(const Snapshot& snapshot) override {
    if (!accepting_) accept();
    std::erase_if(spectators_, [](const auto& one) { return !one->open(); });
    // Without spectators, no message is composed. A spectator that connects later receives the whole
    // snapshot.
    last_ = std::nullopt;
    whole_ = nullptr;
    if (spectators_.empty()) sent_.clear();
    const Text next =
        spectators_.empty() ? nullptr : std::make_shared<const std::string>(next_message(snapshot, sent_));
    last_ = snapshot;
    for (const auto& one : spectators_) {
      if (one->busy())
        one->skip();
      else
        one->send(one->follows() ? next : whole());
    }
  }
  [[nodiscard]] bool settled() const override {
    return std::ranges::none_of(spectators_, [](const auto& one) { return one->open() && one->busy(); });
  }

 private:
  Text whole() {
    if (!whole_) whole_ = std::make_shared<const std::string>(last_ ? whole_message(*last_) : "{}");
    return whole_;
  }
  void accept() {
    accepting_ = true;
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      if (error) {  // for example no free descriptor; the next snapshot calls accept() again
        accepting_ = false;
        return;
      }
      if (site_.connections < most_connections) {
        close_on_exec(socket);
        std::make_shared<Exchange>(site_, std::move(socket), [this](std::shared_ptr<Spectator> spectator) {
          if (last_) spectator->send(whole());
          spectators_.push_back(std::move(spectator));
        })->start();
      }
      accept();
    });
  }

  // The handlers in io_ own the connections, and each connection decrements a count in site_ when it is
  // destroyed. So site_ must outlive io_.
  Site site_;
  Text whole_;
  std::optional<Snapshot> last_;
  Sent sent_;
  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  std::vector<std::shared_ptr<Spectator>> spectators_;
  bool accepting_ = false;
};

}  // namespace

Result<std::unique_ptr<Server>> Server::open(const std::string& address, std::uint16_t port) {
  error_code error;
  const asio::ip::address at = asio::ip::make_address(address, error);
  if (error)
    return failure(
        fmt::format("--live-address '{}': is not an IP address, expected one of this machine", address));
  try {
    return std::make_unique<BeastServer>(tcp::endpoint(at, port), at.is_loopback() ? "" : new_token());
  } catch (const boost::system::system_error& refused) {
    if (refused.code() == asio::error::address_in_use)
      return failure(fmt::format("--live {}: the port is in use, expected a free one, or 0 for any", port));
    if (refused.code() == asio::error::access_denied)
      return failure(fmt::format("--live {}: the port is not permitted, expected one from 1024 on", port));
    return failure(
        fmt::format("--live-address '{}': cannot listen there ({}), expected an address of this machine",
                    address, refused.code().message()));
  }
}

}  // namespace canhil::live
