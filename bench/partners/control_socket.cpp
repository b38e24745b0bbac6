#include "bench/partners/control_socket.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace canhil::partners {

Result<std::unique_ptr<ControlSocket>> ControlSocket::listen(const std::string& path) {
  const auto wrong = [&](const std::string& what, std::string_view expected) {
    return failure(fmt::format("--control '{}': {}, expected {}", path, what, expected));
  };
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path)
    return wrong(fmt::format("has {} bytes", path.size()), "a path of 1 to 107 bytes");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  Descriptor listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  // Nobody else may connect from the first moment on.
  const mode_t before = ::umask(0177);
  const int bound = ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  const int reason = errno;
  ::umask(before);
  if (bound != 0) return wrong(strerror(reason), "a path that does not exist, in a folder of yours");
  if (::listen(listener.get(), 1) != 0) return wrong(strerror(errno), "a socket that listens");
  return std::unique_ptr<ControlSocket>(new ControlSocket(path, std::move(listener)));
}

ControlSocket::~ControlSocket() { ::unlink(path_.c_str()); }

std::unique_ptr<processes::ProgramLines> ControlSocket::accept(std::chrono::milliseconds patience) {
  pollfd one{.fd = listener_.get(), .events = POLLIN, .revents = 0};
  if (::poll(&one, 1, static_cast<int>(patience.count())) <= 0) return nullptr;
  Descriptor client(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
  ucred other{};
  socklen_t size = sizeof other;
  const bool is_own = client && ::getsockopt(client.get(), SOL_SOCKET, SO_PEERCRED, &other, &size) == 0 &&
                      other.uid == ::geteuid();
  if (!is_own) return nullptr;
  auto dialogue = processes::Dialogue::over(std::move(client));
  return dialogue ? std::make_unique<processes::ProgramLines>(*std::move(dialogue)) : nullptr;
}

}  // namespace canhil::partners
