// The sections of scenario and campaign files with all keys that their readers request.
#pragma once

#include <string>
#include <vector>

#include "bench/reference/explore.hpp"

namespace canhil::reference {

/// One table of a file, or one kind of a check, a fault or a metric.
struct Table {
  std::string name;   ///< "[seeker]", "error"
  std::string about;  ///< sentences
  std::vector<AskedKey> keys;
};

/// A chapter of the reference.
struct Part {
  std::string title;
  std::string about;
  std::vector<Table> tables;
};

std::vector<Part> parts();

}  // namespace canhil::reference
