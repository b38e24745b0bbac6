// The name of a file while it is being written.
#pragma once

#include <unistd.h>

#include <string>

namespace canhil {

/// Unique to this process: two processes that write to the same path must not share a temporary file.
inline std::string unfinished_name(const std::string& path) {
  return path + "." + std::to_string(getpid()) + ".part";
}

}  // namespace canhil
