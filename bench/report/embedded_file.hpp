// Text files that are built into a program: embed_texts() of bench/report/CMakeLists.txt makes lists of them.
#pragma once

#include <span>
#include <string_view>

namespace canhil::report {

struct EmbeddedFile {
  std::string_view name;  ///< without its ending
  std::string_view text;
};
using EmbeddedFiles = std::span<const EmbeddedFile>;

}  // namespace canhil::report
