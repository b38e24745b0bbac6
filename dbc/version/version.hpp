// The version of all programs of the project: the project version in CMakeLists.txt, and the git revision of
// the build.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace canhil {

/// A semantic version, see https://semver.org.
struct Version {
  std::uint8_t major = 0, minor = 0, patch = 0;
};

/// The version that project(canhil VERSION ...) in CMakeLists.txt states.
Version version();
/// The version as text, such as "0.2.0".
std::string_view version_text();

/// The git revision of the build. "-dirty" is appended if files differ from that revision; "unknown": the
/// build was not made in a git checkout.
std::string_view revision();

/// The text that --version prints, such as "hil-bench 0.2.0 (revision 0123456789ab)".
std::string version_line(std::string_view program);

}  // namespace canhil
