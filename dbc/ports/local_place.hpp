// The sockets of a user's embedded buses, in a directory that only this user can enter.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "dbc/ports/descriptor.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::local {

/// The directory of this user's buses, created if missing: `canhil` in XDG_RUNTIME_DIR if that directory is
/// private and belongs to the user, else /tmp/canhil-uid-UID. Error: one line, see make_private().
Result<std::string> directory();

/// Creates a directory of mode 0700 unless it exists. Error: one line, if the path is not a directory,
/// belongs to another user, or is open to others.
Result<void> make_private(const std::string& path);

/// The frame format of a bus. Each format has its own socket, so connect() fails for the wrong format, and
/// joining needs no answer from the host.
enum class Format : std::uint8_t { classic, fd };

/// The exclusive right to host a bus, for the lifetime of the object. The kernel releases the lock of a
/// process that dies; the next host removes the sockets of that process.
class Claim {
 public:
  /// Error: one line: the directory cannot be used, or another process hosts the bus already.
  static Result<Claim> take(std::string_view bus, const std::string& name);
  Claim(Claim&& other) noexcept = default;
  Claim& operator=(Claim&& other) = delete;
  ~Claim();

  /// The listening socket of the bus; none: errno says why.
  [[nodiscard]] Descriptor listen(Format format, int backlog) const;

 private:
  Claim(Descriptor lock, std::string path) : lock_(std::move(lock)), path_(std::move(path)) {}
  Descriptor lock_;
  std::string path_;  // common path of the bus's files, without their suffixes
};

/// A connection to the host of a bus; none: errno says why.
Descriptor connect_to(const std::string& directory, const std::string& name, Format format);

/// The process at the other end of a connection, from the kernel.
struct Process {
  pid_t pid = 0;
  uid_t uid = 0;
};
Process process_behind(int socket);
/// "pid 17 of uid 1000".
std::string to_text(const Process& process);
/// True if the process belongs to this user. Processes of different users never share a bus, not even with
/// root.
bool is_of_this_user(const Process& process);

}  // namespace canhil::local
