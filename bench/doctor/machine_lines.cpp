#include "bench/doctor/machine_lines.hpp"

#include <fmt/format.h>

#include <fstream>

#include "dbc/realtime/host.hpp"

namespace canhil::doctor {
namespace {

Line kernel_line(const Machine& machine) {
  const std::string found = "preemption: " + machine.preemption;
  if (machine.preemption == "PREEMPT_RT") return {Grade::good, "kernel", found};
  return {Grade::weak, "kernel", found, "Debian: `apt install linux-image-rt-amd64` and start it"};
}

Line rights_line(const Machine& machine) {
  if (machine.refusal.empty())
    return {Grade::good, "real time", "SCHED_FIFO and locked memory are permitted"};
  constexpr std::string_view option = "--realtime: ";
  const std::string why =
      machine.refusal.starts_with(option) ? machine.refusal.substr(option.size()) : machine.refusal;
  const std::size_t remedy = why.find(": ");
  return {Grade::weak, "real time", why.substr(0, remedy),
          remedy == std::string::npos ? "" : why.substr(remedy + 2)};
}

Line frequency_line(const Machine& machine) {
  if (machine.governors.empty()) return {Grade::good, "frequency", "not scaled by this kernel"};
  const std::string found = fmt::format("governor {}", fmt::join(machine.governors, ", "));
  if (!realtime::scales_with_load(machine.governors)) return {Grade::good, "frequency", found};
  return {Grade::weak, "frequency", found + ": follows the load",
          "`sudo cpupower frequency-set -g performance` (Debian: linux-cpupower)"};
}

Line cpus_line(const Machine& machine) {
  const std::string found =
      fmt::format("{} ({}), isolated: {}", machine.cpus.size(), realtime::list(machine.cpus),
                  machine.isolated.empty() ? "none" : machine.isolated);
  if (machine.cpus.size() > 1) return {Grade::good, "CPUs", found};
  return {Grade::weak, "CPUs", found,
          "two or more, so that the bench does not share one with its target or with other work"};
}

}  // namespace

std::vector<Line> machine_lines(const Machine& machine) {
  return {kernel_line(machine), rights_line(machine), frequency_line(machine), cpus_line(machine)};
}

std::string isolated_cpus() {
  std::ifstream file(std::string(realtime::cpu_folder) + "/isolated");
  std::string list;
  std::getline(file, list);
  return list;
}

}  // namespace canhil::doctor
