// The version of all programs of the project: CMake's project version, and the git revision of the build.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace canhil {

/// Semantic version, https://semver.org.
struct Version {
  std::uint8_t major = 0, minor = 0, patch = 0;
};

/// The version in project(canhil VERSION ...) of CMakeLists.txt.
Version version();
/// "0.2.0"
std::string_view version_text();

/// The git revision of the build, with "-dirty" if files were altered; "unknown" outside a checkout.
std::string_view revision();

/// What --version prints: "hil-bench 0.2.0 (revision 0123456789ab)".
std::string version_line(std::string_view program);

}  // namespace canhil
