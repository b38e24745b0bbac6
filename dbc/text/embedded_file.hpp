// Text files built into a program; cmake/embed_texts.cmake generates their lists.
#pragma once

#include <span>
#include <string_view>

namespace canhil {

struct EmbeddedFile {
  std::string_view name;  ///< without its extension
  std::string_view text;
};
using EmbeddedFiles = std::span<const EmbeddedFile>;

}  // namespace canhil
