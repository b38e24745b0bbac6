// The origin of a report: machine, kernel, CPU, time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace canhil::report {

/// The name of this machine; "unknown" if it has none.
std::string host_name();

/// Release and version of the running kernel from uname.
std::string kernel();

/// The model of the CPU from the text of /proc/cpuinfo; "unknown" if absent.
std::string cpu_model(std::string_view cpuinfo);
std::string cpu_model();

/// 2026-01-31T12:00:00Z; "unknown" for 0.
std::string date_utc(std::int64_t seconds_since_1970);

}  // namespace canhil::report
