// Where the embedded buses of a user live: sockets in a directory that nobody else can enter.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "dbc/ports/descriptor.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::local {

/// The directory of this user's buses, made where it is not there yet: `canhil` in XDG_RUNTIME_DIR, if that
/// is the user's own and private, else /tmp/canhil-uid-UID. Error: one line, see make_private().
Result<std::string> directory();

/// Makes a directory of mode 0700, unless there is one. Error: one line, if something else has the name, or
/// it is not this user's, or others may enter it.
Result<void> make_private(const std::string& path);

/// The formats of a bus. Each has a socket of its own, so a node learns of the wrong one from connect()
/// alone, and joining needs no answer from the host.
enum class Place : std::uint8_t { classic, fd };

/// The right to host a bus: while this lives nobody else gets it. The kernel takes it back from a process
/// that dies; the sockets that such a process left behind are removed by the next host.
class Claim {
 public:
  /// Error: one line: the directory is unfit, or somebody hosts the bus already.
  static Result<Claim> take(std::string_view bus, const std::string& name);
  Claim(Claim&& other) noexcept = default;
  Claim& operator=(Claim&& other) = delete;
  ~Claim();

  /// The listening socket of the bus; none: errno says why.
  [[nodiscard]] Descriptor listen(Place place, int backlog) const;

 private:
  Claim(Descriptor lock, std::string path) : lock_(std::move(lock)), path_(std::move(path)) {}
  Descriptor lock_;
  std::string path_;  // of the bus, without the end that tells its files apart
};

/// A connection to the host of a bus; none: errno says why.
Descriptor connect_to(const std::string& directory, const std::string& name, Place place);

/// The process at the other end of a connection, or the one that listened at it, as the kernel knows it.
struct Process {
  pid_t pid = 0;
  uid_t uid = 0;
};
Process process_behind(int socket);
/// "pid 17 of uid 1000".
std::string to_text(const Process& process);
/// Only processes of the same user share a bus, root not excepted.
bool is_of_this_user(const Process& process);

}  // namespace canhil::local
