// Frames to answers: an estimator's folder puts the groups of its answers together.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "bench/checks/observations.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil::estimators {

/// A group that was whole, and what it answers.
struct Whole {
  std::span<const std::size_t> messages;  ///< their places in TimingRecord::messages
  std::int64_t cause_us = 0;              ///< time of validity of the cause
  std::string_view cause_group;
  std::optional<std::uint8_t> cause_counter{};  ///< of the cause; none: the group does not carry it
};

/// Of one run.
class Reception {
 public:
  Reception() = default;
  Reception(const Reception&) = delete;
  Reception& operator=(const Reception&) = delete;
  virtual ~Reception() = default;

  /// Whether it takes a message, by its place in all_messages.
  [[nodiscard]] virtual bool takes(std::size_t message) const = 0;
  /// Takes a frame of such a message, whose CRC is right. `now_us`: of the last Sync. The answer that it
  /// completes goes into `seen`; none: the group is not whole yet.
  virtual std::optional<Whole> take(const Frame& frame, std::size_t message, std::int64_t now_us,
                                    checks::Observations& seen) = 0;
  /// The last frame of a sample group that somebody answers was sent.
  virtual void sent(std::string_view /*group*/, std::int64_t /*valid_us*/, checks::Observations& /*seen*/) {}
};

}  // namespace canhil::estimators
