#include "dbc/version/version.hpp"

#include "dbc/version/revision.hpp"

namespace canhil {

Version version() { return {CANHIL_VERSION_MAJOR, CANHIL_VERSION_MINOR, CANHIL_VERSION_PATCH}; }

std::string_view version_text() { return CANHIL_VERSION; }

std::string_view revision() { return CANHIL_REVISION; }

std::string version_line(std::string_view program) {
  return std::string(program) + " " + CANHIL_VERSION + " (revision " + CANHIL_REVISION + ")";
}

}  // namespace canhil
