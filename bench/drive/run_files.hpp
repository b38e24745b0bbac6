// The files that a run depends on, for the provenance of its report.
#pragma once

#include <string>
#include <vector>

#include "bench/drive/file_identity.hpp"

namespace canhil::scenario {
struct Scenario;
}

namespace canhil::drive {

struct Options;

/// A file and its role in the run: "bench", "target", "target argument", "scenario", "mapping", "DBC",
/// "recording", "plant", "faults", "log".
struct RunFile {
  std::string role;
  std::string name;
  FileIdentity identity{};
};

/// The files as they are on disk now; unreadable files are left out. canhil's own DBC is compiled in, so its
/// entry has neither size nor date. `in_process`: no target program is started.
std::vector<RunFile> files_of(const scenario::Scenario& scenario, const Options& options, bool in_process);

}  // namespace canhil::drive
