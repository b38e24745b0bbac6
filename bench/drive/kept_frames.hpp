// Keeps every frame of a flight, for the part of the report that shows those around a moment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "bench/drive/onlooker.hpp"
#include "dbc/spool/spool.hpp"

namespace canhil::drive {

/// Frames in the order in which they passed, from the bench's first transmission on. A classic frame takes at
/// most 32 bytes: the first 2 MiB are in memory, the rest is in a file (Spool).
class KeptFrames final : public Onlooker {
 public:
  struct Kept {
    std::int64_t t_us =
        0;  ///< since the bench's first transmission; in virtual time: since the begin of the run
    Frame frame{};
    bool transmitted = false;  ///< by the bench; its stamp is the time of the hand-over
  };

  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  /// Echoes of the bench's own frames are left out.
  void received(const Received& received) override;
  void time_set(std::int64_t t_ns) override { virtual_ns_ = t_ns; }

  [[nodiscard]] std::size_t size() const { return heads_.size(); }
  [[nodiscard]] Kept operator[](std::size_t index) const;
  /// The index of the first frame at a time or after it; size(): there is none.
  [[nodiscard]] std::size_t first_from(std::int64_t t_us) const;

 private:
  struct Head {
    std::int64_t t_us;
    std::size_t first_byte;
    std::uint32_t id;
    std::uint8_t size;
    bool extended : 1, fd : 1, error : 1, transmitted : 1;
  };
  void keep(const Frame& frame, std::int64_t t_ns, bool transmitted);

  Spool<Head> heads_;
  Spool<std::uint8_t> bytes_;
  std::optional<std::int64_t> first_ns_, virtual_ns_;
};

}  // namespace canhil::drive
