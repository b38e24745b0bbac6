// Reads the samples of a sensor from frames of canhil.dbc.
#pragma once

#include <optional>
#include <vector>

#include "bench/nodes/kind.hpp"

namespace canhil::nodes {

class SampleDecoder {
 public:
  /// `kind` must outlive the decoder.
  explicit SampleDecoder(const Kind& kind);

  /// Whether a frame has the id of one of the sensor's messages.
  [[nodiscard]] bool has(const Frame& frame) const;
  /// The sample that this frame completes. A sample is complete if its group has a whole frame of each
  /// message, all with one counter. Times are unwrapped: the time of the sample before determines the number
  /// of periods.
  std::optional<sensors::Sample> take(const Frame& frame);
  /// The number of samples that the counters lack before the latest complete sample.
  [[nodiscard]] int lost() const { return lost_; }

 private:
  struct Part {
    std::uint32_t id = 0;
    /// Reads the values of a frame into a sample; false: the frame is not whole.
    bool (*decode)(const Frame& frame, const SampleSignal* signals, std::int64_t before_us,
                   sensors::Sample& sample) = nullptr;
    const SampleSignal* signals = nullptr;
    bool seen = false;
  };
  std::vector<Part> parts_;
  sensors::Sample sample_;
  std::int64_t before_us_ = 0;          // time of validity of the latest complete sample
  std::uint8_t counter_ = 0;            // of the group that is being completed
  std::optional<std::uint8_t> latest_;  // counter of the latest complete sample
  int lost_ = 0;
};

}  // namespace canhil::nodes
