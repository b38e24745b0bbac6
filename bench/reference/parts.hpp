// The parts of the reference: the sections of scenario and campaign files with all keys that their readers
// request.
#pragma once

#include <string>
#include <vector>

#include "bench/reference/explore.hpp"

namespace canhil::reference {

/// One table of a file, or one kind of check, fault or metric.
struct Table {
  std::string name;   ///< for example "[seeker]" or "error"
  std::string about;  ///< explanation in sentences; may be empty
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
