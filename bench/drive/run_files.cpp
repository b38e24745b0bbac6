#include "bench/drive/run_files.hpp"

#include <filesystem>

#include "bench/drive/session.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/scenario/foreign.hpp"

namespace canhil::drive {

std::vector<RunFile> files_of(const scenario::Scenario& scenario, const Options& options, bool in_process) {
  std::vector<RunFile> files;
  const auto add = [&](const std::string& role, const std::string& path) {
    if (auto identity = identify_file(path)) files.push_back({role, path, std::move(*identity)});
  };
  std::error_code unknown;
  add("bench", std::filesystem::read_symlink("/proc/self/exe", unknown).string());
  if (options.target && !in_process) {
    for (const std::string& file : files_of_target(*options.target))
      add(file == files_of_target(*options.target).front() ? "target" : "target argument", file);
  }
  add("scenario", scenario.file);
  for (const scenario::InputFile& input : scenario.inputs) add(input.role, input.path);
  if (scenario.foreign != nullptr) {
    add("mapping", scenario.foreign->file);
    add("DBC", scenario.foreign->dbc_file);
  } else {
    const bool fd = options.format == BusFormat::fd;
    files.push_back({"DBC",
                     fd ? "canhil-fd.dbc (built in)" : "canhil.dbc (built in)",
                     {.sha256 = fd ? CANHIL_FD_DBC_SHA256 : CANHIL_DBC_SHA256}});
  }
  return files;
}

}  // namespace canhil::drive
