#include "bench/commands/become.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "bench/commands/exit_code.hpp"

namespace canhil::commands {

int become(const std::string& program, std::vector<std::string> words) {
  std::error_code unknown;
  const auto own = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string path = (own.parent_path() / program).string();
  words.insert(words.begin(), "hil-bench");  // the name that it goes by in help
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(path.c_str(), arguments.data());
  return static_cast<int>(
      complain({fmt::format("{}: {}, expected it beside hil-bench: cmake --build build/default --target {}",
                            path, std::strerror(errno), program)}));
}

}  // namespace canhil::commands
