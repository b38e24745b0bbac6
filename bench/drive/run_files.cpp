#include "bench/drive/run_files.hpp"

#include <algorithm>
#include <filesystem>

#include "bench/drive/inputs.hpp"
#include "bench/drive/session.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/scenario/binding.hpp"

namespace canhil::drive {

std::vector<CommandFiles::File> inputs_of(const scenario::Scenario& scenario) {
  std::vector<CommandFiles::File> files{{"scenario", scenario.file}};
  for (const scenario::InputFile& input : scenario.inputs) files.push_back({input.role, input.path});
  const auto add = [&](const std::string& role, const std::string& path) {
    if (std::ranges::find(files, path, &CommandFiles::File::path) == files.end())
      files.push_back({role, path});
  };
  for (const auto& [mapping, dbc] : scenario.binding->files) {
    add("mapping", mapping);
    add("DBC", dbc);
  }
  return files;
}

std::vector<CommandFiles::File> inputs_of_target(const std::string& command) {
  std::vector<CommandFiles::File> files;
  for (const std::string& file : files_of_target(command))
    files.push_back({files.empty() ? "target" : "target argument", file});
  return files;
}

std::vector<RunFile> files_of(const scenario::Scenario& scenario, const Options& options, bool in_process) {
  std::vector<RunFile> files;
  const auto add = [&](const std::vector<CommandFiles::File>& named) {
    for (const auto& [role, path] : named) {
      if (auto identity = identify_file(path)) files.push_back({role, path, std::move(*identity)});
    }
  };
  std::error_code unknown;
  add({{"bench", std::filesystem::read_symlink("/proc/self/exe", unknown).string()}});
  for (const std::string& command : options.targets)
    if (!in_process) add(inputs_of_target(command));
  add(inputs_of(scenario));
  if (scenario.binding->files.empty()) {
    const bool fd = options.format == BusFormat::fd;
    files.push_back({"DBC",
                     fd ? "canhil-fd.dbc (built in)" : "canhil.dbc (built in)",
                     {.sha256 = fd ? CANHIL_FD_DBC_SHA256 : CANHIL_DBC_SHA256}});
  }
  return files;
}

}  // namespace canhil::drive
