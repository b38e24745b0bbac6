#include "dbc/files/text_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace canhil {
namespace {

std::string size_text(std::size_t bytes) {
  return bytes % mebibyte == 0 ? fmt::format("{} MiB", bytes / mebibyte) : fmt::format("{} bytes", bytes);
}

}  // namespace

Result<std::string> read_text_file(const std::filesystem::path& path, std::string_view kind,
                                   std::size_t most_bytes) {
  const auto unreadable = [&](int reason) {
    return failure(fmt::format("{}: cannot be read ({}), expected {}", path.string(),
                               std::generic_category().message(reason), kind));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return unreadable(EISDIR);  // opening a directory would succeed
  std::ifstream file(path, std::ios::binary);
  if (!file) return unreadable(errno);
  std::string content;
  std::array<char, 65536> piece{};
  while (file.read(piece.data(), piece.size()), file.gcount() > 0) {
    content.append(piece.data(), static_cast<std::size_t>(file.gcount()));
    if (content.size() > most_bytes) {
      return failure(fmt::format("{}: is larger than {}, expected {} of at most that", path.string(),
                                 size_text(most_bytes), kind));
    }
  }
  if (file.bad()) return unreadable(EIO);
  return content;
}

}  // namespace canhil
