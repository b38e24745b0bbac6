#include "bench/drive/program_file.hpp"

#include <sys/stat.h>

#include <fstream>
#include <string_view>
#include <vector>

#include "bench/world/hash.hpp"

namespace canhil::drive {

std::optional<ProgramFile> look_at_program(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  constexpr std::size_t block_bytes = 1 << 16;
  std::vector<char> block(block_bytes);
  ProgramFile program{.hash = world::fnv1a_64(""), .bytes = 0, .modified_s = status.st_mtim.tv_sec};
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
    const auto count = static_cast<std::size_t>(file.gcount());
    program.hash = world::fnv1a_64(std::string_view(block.data(), count), program.hash);
    program.bytes += count;
  }
  return program;
}

}  // namespace canhil::drive
