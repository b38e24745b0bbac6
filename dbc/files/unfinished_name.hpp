// What a file is called until it is whole.
#pragma once

#include <unistd.h>

#include <string>

namespace canhil {

/// A name of this process alone: two that are told the same path must not write into one file.
inline std::string unfinished_name(const std::string& path) {
  return path + "." + std::to_string(getpid()) + ".part";
}

}  // namespace canhil
