// Reads files that a section names.
#include "bench/scenario/section.hpp"
#include "bench/world/hash.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::scenario {

std::optional<std::string> Section::read_beside(const Key& key, std::string_view kind,
                                                std::size_t most_bytes) {
  const std::string named = text(key);
  if (named.empty()) return std::nullopt;
  auto content = read_text_file(beside(named), kind, most_bytes);
  if (!content) {
    reject(key.name, content.error());
    return std::nullopt;
  }
  files().push_back(beside(named));
  std::uint64_t& hash = files_hash();
  hash = world::fnv1a_64(*content, hash == 0 ? world::fnv1a_64("") : hash);
  return std::move(*content);
}

}  // namespace canhil::scenario
