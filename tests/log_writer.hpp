// Writes a log for a test.
#pragma once

#include <cstdio>
#include <string>

#include "dbc/logs/log.hpp"

namespace canhil::test {

/// Writes to the file `path`. `name`: see LogWriter; empty: `path`.
inline LogWriter log_writer(const std::string& path, const std::string& name = {}) {
  return LogWriter::create(std::fopen(path.c_str(), "w"), name.empty() ? path : name).value();
}

}  // namespace canhil::test
