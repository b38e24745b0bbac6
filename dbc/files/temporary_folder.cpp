#include "dbc/files/temporary_folder.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace canhil {
namespace fs = std::filesystem;

Result<std::unique_ptr<TemporaryFolder>> TemporaryFolder::make(std::string_view name) {
  std::error_code error;
  std::string pattern = (fs::temp_directory_path(error) / fmt::format("canhil-{}-XXXXXX", name)).string();
  if (error || ::mkdtemp(pattern.data()) == nullptr)
    return failure(fmt::format("a temporary folder cannot be made ({}: {})", pattern,
                               error ? error.message() : std::generic_category().message(errno)));
  return std::make_unique<TemporaryFolder>(pattern);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace canhil
