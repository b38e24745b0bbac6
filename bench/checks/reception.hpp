// Turns frames into answers. The folder of each estimator contains the code that assembles the answer groups
// of this estimator.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "bench/checks/observations.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil::estimators {

/// A complete group and its cause.
struct Whole {
  std::span<const std::size_t> messages;  ///< indices in TimingRecord::messages
  std::int64_t cause_us = 0;              ///< time of validity of the cause
  std::string_view cause_group;
  std::optional<std::uint8_t> cause_counter{};  ///< counter of the cause; none: not in the group
};

/// The reception of one run.
class Reception {
 public:
  Reception() = default;
  Reception(const Reception&) = delete;
  Reception& operator=(const Reception&) = delete;
  virtual ~Reception() = default;

  /// Whether the estimator's answers contain a message. `message`: its index in all_messages.
  [[nodiscard]] virtual bool takes(std::size_t message) const = 0;
  /// Takes a frame that has a valid CRC and belongs to a message for which takes() is true. `now_us`: time of
  /// the last Sync. If the frame completes an answer, adds the answer to `seen` and returns the answer's
  /// group. None: the group is not complete yet.
  virtual std::optional<Whole> take(const Frame& frame, std::size_t message, std::int64_t now_us,
                                    checks::Observations& seen) = 0;
  /// Called when the bench has sent the last frame of a sample group that some estimator answers.
  virtual void sent(std::string_view /*group*/, std::int64_t /*valid_us*/, checks::Observations& /*seen*/) {}
};

}  // namespace canhil::estimators
