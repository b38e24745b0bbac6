#include "bench/report/file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "dbc/text/escape.hpp"

namespace canhil::report {

Result<void> write_stdout(std::string_view content) {
  const bool written = std::fwrite(content.data(), 1, content.size(), stdout) == content.size();
  if (written && std::fflush(stdout) == 0) return {};
  return failure(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
}

Result<void> show(std::string_view text) { return write_stdout(for_terminal(text)); }

Result<void> write(const std::string& path, std::string_view content) {
  return path == to_stdout ? write_stdout(content) : write_file(path, content);
}

}  // namespace canhil::report
