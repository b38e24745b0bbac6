#include "dbc/ports/ancillary.hpp"

#include <linux/errqueue.h>

#include <cstring>
#include <ctime>

namespace canhil {
namespace {

std::int64_t to_ns(const timespec& t) { return t.tv_sec * 1'000'000'000LL + t.tv_nsec; }

}  // namespace

Ancillary read_ancillary(msghdr& message) {
  Ancillary said;
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SO_TIMESTAMPING) continue;
    scm_timestamping stamps{};  // ts[0]: software stamp, ts[2]: raw hardware stamp
    std::memcpy(&stamps, CMSG_DATA(part), sizeof stamps);
    said.software_ns = to_ns(stamps.ts[0]);
    said.hardware_ns = to_ns(stamps.ts[2]);
  }
  return said;
}

}  // namespace canhil
