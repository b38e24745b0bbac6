// The sockets of the embedded buses of a user. They are in a directory that only this user can enter.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "dbc/ports/descriptor.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::local {

/// The directory for the buses of this user; creates the directory if it is missing. It is `canhil` in
/// XDG_RUNTIME_DIR if XDG_RUNTIME_DIR is private and belongs to the user, otherwise /tmp/canhil-uid-UID.
/// Errors are those of make_private().
Result<std::string> directory();

/// Creates a directory of mode 0700 if the path does not exist. Returns an error of one line if the path is
/// not a directory, belongs to another user, or can be entered by other users.
Result<void> make_private(const std::string& path);

/// The frame format of a bus. Each format has its own socket. So connect() fails for the wrong format, and a
/// node can join without an answer of the host.
enum class Format : std::uint8_t { classic, fd };

/// The exclusive right to host a bus, for the lifetime of the object. If a process dies, the kernel releases
/// its lock, and the next host removes its sockets.
class Claim {
 public:
  /// Takes the right to host a bus. Returns an error of one line if the directory cannot be used, or if
  /// another process hosts the bus already.
  static Result<Claim> take(std::string_view bus, const std::string& name);
  Claim(Claim&& other) noexcept = default;
  Claim& operator=(Claim&& other) = delete;
  ~Claim();

  /// Creates the listening socket of the bus. An empty descriptor is returned on failure; errno then has the
  /// reason.
  [[nodiscard]] Descriptor listen(Format format, int backlog) const;

 private:
  Claim(Descriptor lock, std::string path) : lock_(std::move(lock)), path_(std::move(path)) {}
  Descriptor lock_;
  std::string path_;  // common path of the files of this bus, without their suffixes
};

/// Makes a connection to the host of a bus. An empty descriptor is returned on failure; errno then has the
/// reason.
Descriptor connect_to(const std::string& directory, const std::string& name, Format format);

/// The process at the other end of a connection, as the kernel reports it.
struct Process {
  pid_t pid = 0;
  uid_t uid = 0;
};
Process process_behind(int socket);
/// The process as text, such as "pid 17 of uid 1000".
std::string to_text(const Process& process);
/// True if the process belongs to this user. Processes of different users never share a bus, also if one of
/// the users is root.
bool is_of_this_user(const Process& process);

}  // namespace canhil::local
