#include "bench/report/provenance.hpp"

#include <fmt/chrono.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <iterator>

namespace canhil::report {

std::string host_name() {
  utsname name{};
  if (uname(&name) != 0 || name.nodename[0] == '\0') return "unknown";
  return name.nodename;
}

std::string kernel() {
  utsname name{};
  if (uname(&name) != 0) return "unknown";
  return std::string(name.release) + " " + name.version;
}

std::string cpu_model(std::string_view cpuinfo) {
  for (const std::string_view key : {"model name", "Model", "Hardware"}) {
    for (auto at = cpuinfo.find(key); at != std::string_view::npos; at = cpuinfo.find(key, at + 1)) {
      if (at != 0 && cpuinfo[at - 1] != '\n') continue;
      const std::string_view line = cpuinfo.substr(at, cpuinfo.find('\n', at) - at);
      const auto colon = line.find(": ");
      if (colon != std::string_view::npos) return std::string(line.substr(colon + 2));
    }
  }
  return "unknown";
}

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  return cpu_model(std::string(std::istreambuf_iterator<char>(file), {}));
}

std::string date_utc(std::int64_t seconds_since_1970) {
  if (seconds_since_1970 == 0) return "unknown";
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time_t{seconds_since_1970}));
}

}  // namespace canhil::report
