#include "dbc/ports/local_place.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace canhil::local {
namespace {

constexpr std::array<std::string_view, 2> format_suffixes{".classic", ".fd"};
constexpr std::size_t longest_name = 64;
constexpr std::size_t longest_directory =
    sizeof sockaddr_un{}.sun_path - 1 - longest_name - format_suffixes[0].size() - 1;

bool is_ours_alone(const struct stat& entry) {
  return S_ISDIR(entry.st_mode) && entry.st_uid == ::geteuid() && (entry.st_mode & 077U) == 0;
}

std::string socket_of(const std::string& path, Format format) {
  return path + std::string(format_suffixes.at(static_cast<std::size_t>(format)));
}
std::string lock_of(const std::string& path) { return path + ".lock"; }

sockaddr_un address(const std::string& path) {
  sockaddr_un result{};
  result.sun_family = AF_UNIX;
  path.copy(result.sun_path, sizeof result.sun_path - 1);
  return result;
}

Descriptor new_socket() {
  return Descriptor(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

// True if `path` is still the name of the opened file. When a host ends, it removes its lock file; and a lock
// on a removed file does not exclude other processes.
bool still_named(const Descriptor& file, const std::string& path) {
  struct stat opened {
  }, named{};
  return ::fstat(file.get(), &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

Result<void> make_private(const std::string& path) {
  if (::mkdir(path.c_str(), 0700) != 0 && errno != EEXIST)
    return failure(fmt::format("directory '{}': {}", path, std::strerror(errno)));
  struct stat entry {};
  if (::lstat(path.c_str(), &entry) != 0)
    return failure(fmt::format("directory '{}': {}", path, std::strerror(errno)));
  if (is_ours_alone(entry)) return {};
  return failure(fmt::format(
      "'{}': expected a directory of uid {} with mode 0700, is {} of uid {} with mode {:04o}; remove "
      "it, or set XDG_RUNTIME_DIR to a private directory",
      path, ::geteuid(),
      S_ISDIR(entry.st_mode)   ? "a directory"
      : S_ISLNK(entry.st_mode) ? "a symbolic link"
                               : "a file",
      entry.st_uid, entry.st_mode & 07777U));
}

Result<std::string> directory() {
  const char* set = std::getenv("XDG_RUNTIME_DIR");
  const std::string runtime = set == nullptr ? "" : set;
  struct stat entry {};
  std::string path = runtime + "/canhil";
  // XDG_RUNTIME_DIR is not always usable: after su or sudo it may be the directory of another user, and a
  // long path leaves no room for the name of a socket.
  const bool fit = runtime.starts_with('/') && path.size() <= longest_directory &&
                   ::lstat(runtime.c_str(), &entry) == 0 && is_ours_alone(entry);
  if (!fit) path = fmt::format("/tmp/canhil-uid-{}", ::geteuid());
  if (auto made = make_private(path); !made) return tl::unexpected(made.error());
  return path;
}

Result<Claim> Claim::take(std::string_view bus, const std::string& name) {
  const auto parent = directory();
  if (!parent) return failure(fmt::format("bus '{}': {}", bus, parent.error().message));
  const std::string path = *parent + "/" + name;
  const std::string lock_path = lock_of(path);
  for (;;) {
    Descriptor lock(::open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (!lock) return failure(fmt::format("bus '{}': {}: {}", bus, lock_path, std::strerror(errno)));
    if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) {
      if (errno == EINTR) continue;
      return failure(
          fmt::format("bus '{}' is hosted already by another process: join it or take another name", bus));
    }
    if (!still_named(lock, lock_path)) continue;
    for (const Format left_behind : {Format::classic, Format::fd})
      ::unlink(socket_of(path, left_behind).c_str());
    return Claim(std::move(lock), path);
  }
}

Claim::~Claim() {
  if (!lock_) return;
  for (const Format format : {Format::classic, Format::fd}) ::unlink(socket_of(path_, format).c_str());
  ::unlink(lock_of(path_).c_str());  // must happen before the lock is released, see still_named()
}

Descriptor Claim::listen(Format format, int backlog) const {
  Descriptor socket = new_socket();
  const sockaddr_un at = address(socket_of(path_, format));
  if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0 ||
      ::listen(socket.get(), backlog) != 0) {
    return {};
  }
  return socket;
}

Descriptor connect_to(const std::string& directory, const std::string& name, Format format) {
  Descriptor socket = new_socket();
  const sockaddr_un at = address(socket_of(directory + "/" + name, format));
  if (::connect(socket.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0) return {};
  return socket;
}

Process process_behind(int socket) {
  ucred credentials{.pid = 0, .uid = static_cast<uid_t>(-1), .gid = 0};
  socklen_t length = sizeof credentials;
  ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &credentials, &length);
  return {.pid = credentials.pid, .uid = credentials.uid};
}

std::string to_text(const Process& process) {
  return fmt::format("pid {} of uid {}", process.pid, process.uid);
}

bool is_of_this_user(const Process& process) { return process.uid == ::geteuid(); }

}  // namespace canhil::local
