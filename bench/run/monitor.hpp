// Frames to observations: decodes what the target sends, pairs it with its cause, keeps the stamps.
#pragma once

#include <array>
#include <optional>

#include "bench/checks/observations.hpp"
#include "bench/run/link.hpp"
#include "bench/run/stopwatch.hpp"
#include "dbc/wire/e2e.hpp"
#include "dbc/wire/sample_group.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::run {

/// Watches a run from the target's start on.
class Monitor final : public Observer {
 public:
  /// Takes no times: those of virtual time say nothing, and a campaign flies thousands of runs in it.
  Monitor() {}  // not defaulted: Monitor() would then clear the large place of the stopwatch, too
  /// Takes times, also within the windows.
  explicit Monitor(std::vector<checks::TimedWindow> windows, const WireFacts& wire = {}) {
    seen_.timing.windows = std::move(windows);
    seen_.timing.wire = wire;
    stopwatch_.emplace(seen_.timing);
  }

  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;

  /// What was seen so far.
  [[nodiscard]] const checks::Observations& observations() const { return seen_; }
  /// The run is over: all of it.
  checks::Observations finish() {
    if (stopwatch_) stopwatch_->finish();
    return std::move(seen_);
  }

 private:
  void echoed(const Received& received);
  void decode(const Frame& frame, std::size_t index);
  template <class Attitude, class VelocityNE, class VelocityD>
  void on_navigation(const SampleGroup<Attitude, VelocityNE, VelocityD>& group,
                     std::vector<checks::NavigationAnswer>& answers);
  void on_filter();
  void on_fix();
  void on_wind();
  void on_los();
  template <class... Messages>
  static bool put(SampleGroup<Messages...>& group, const Frame& frame, std::uint8_t counter);
  template <class... Messages>
  void attribute(const SampleGroup<Messages...>& group, std::int64_t cause_us, std::string_view cause_group);

  checks::Observations seen_;
  std::optional<Stopwatch> stopwatch_;
  bool sent_any_ = false;
  std::array<e2e::Receiver, messages::all_messages.size()> receivers_{};
  SampleGroup<messages::AlignAttitude, messages::AlignVelocityNE, messages::AlignVelocityD> navigation_;
  SampleGroup<messages::FixAttitude, messages::FixVelocityNE, messages::FixVelocityD> fix_navigation_;
  SampleGroup<messages::AlignInnovation, messages::AlignAttitudeSigma, messages::AlignAttitudeCorrelation,
              messages::AlignVelocitySigma, messages::AlignGyroBias, messages::AlignGyroBiasSigma,
              messages::AlignAccelBias, messages::AlignAccelBiasSigma, messages::AlignUpdate>
      filter_;
  SampleGroup<messages::FixInnovation, messages::FixPositionLatitude, messages::FixPositionLongitude,
              messages::FixAttitudeSigma, messages::FixVelocitySigma, messages::FixPositionSigma,
              messages::FixGyroBias, messages::FixGyroBiasSigma, messages::FixAccelBias,
              messages::FixAccelBiasSigma, messages::FixBias, messages::FixBiasSigma, messages::FixStatus,
              messages::FixUpdate>
      fix_;
  SampleGroup<messages::WindVector, messages::WindSpeed, messages::WindSigma, messages::WindCorrelation,
              messages::WindTrackSigma, messages::WindAirVelocity, messages::WindAttitude,
              messages::WindInnovation, messages::WindUpdate>
      wind_;
  SampleGroup<messages::LosRateEstimate, messages::LosRateSigma, messages::LosRateTarget> los_;
  std::int64_t now_us_ = 0;  // last Sync
};

}  // namespace canhil::run
