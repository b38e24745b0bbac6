#include "bench/drive/kept_frames.hpp"

#include <algorithm>

namespace canhil::drive {

void KeptFrames::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t /*late_ns*/) {
  if (!first_ns_) first_ns_ = t_ns;
  keep(frame, t_ns, true);
}

void KeptFrames::received(const Received& received) {
  if (first_ns_ && !received.own) keep(received.frame, received.t_ns, false);
}

void KeptFrames::keep(const Frame& frame, std::int64_t t_ns, bool transmitted) {
  heads_.push_back({.t_us = (virtual_ns_ ? *virtual_ns_ : t_ns - *first_ns_) / 1000,
                    .first_byte = bytes_.size(),
                    .id = frame.id,
                    .size = frame.size,
                    .extended = frame.extended,
                    .fd = frame.fd,
                    .error = frame.error,
                    .transmitted = transmitted});
  for (const std::uint8_t byte : frame.payload()) bytes_.push_back(byte);
}

KeptFrames::Kept KeptFrames::operator[](std::size_t index) const {
  const Head& head = heads_[index];
  Kept kept{.t_us = head.t_us,
            .frame = {.id = head.id,
                      .size = head.size,
                      .extended = head.extended,
                      .fd = head.fd,
                      .error = head.error},
            .transmitted = head.transmitted};
  for (std::size_t i = 0; i < head.size; ++i) kept.frame.data[i] = bytes_[head.first_byte + i];
  return kept;
}

// A frame may have an older stamp than the frame before it, if several sources stamp them; the error is of a
// few frames.
std::size_t KeptFrames::first_from(std::int64_t t_us) const {
  const auto found =
      std::lower_bound(heads_.begin(), heads_.end(), t_us,
                       [](const Head& head, std::int64_t than_us) { return head.t_us < than_us; });
  return static_cast<std::size_t>(found - heads_.begin());
}

}  // namespace canhil::drive
