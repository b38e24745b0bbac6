// The temporary name of a file, which is used until the file is complete.
#pragma once

#include <unistd.h>

#include <string>

namespace canhil {

/// The name contains the process id, so that two processes that write to the same path use different
/// temporary files.
inline std::string unfinished_name(const std::string& path) {
  return path + "." + std::to_string(getpid()) + ".part";
}

}  // namespace canhil
