// Turns frames into observations: decodes the target's frames, pairs the answers with their causes, records
// time stamps.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/checks/reception.hpp"
#include "bench/observe/stopwatch.hpp"
#include "bench/observe/watcher.hpp"
#include "bench/protocol/receiver_model.hpp"
#include "dbc/wire/e2e.hpp"

namespace canhil::protocol {

/// What a verdict needs in addition to the answers.
struct Asked {
  std::vector<checks::TimedWindow> windows{};  ///< windows of the checks that judge timing
  WireFacts wire{};
  Takers takers{};
  std::map<std::string_view, double> own_interval_s{};  ///< see Observations
};

/// Watches a run from the target's start on.
class Monitor final : public observe::Watcher {
 public:
  /// Without `asked`, the monitor measures no times. A campaign saves this work in its thousands of runs,
  /// because a campaign judges no times.
  explicit Monitor(std::optional<Asked> asked = std::nullopt);

  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;
  void target_restarts() override;

  [[nodiscard]] const checks::Observations& observations() const override { return seen_; }
  checks::Observations finish() override;

 private:
  void flight_goes_on();
  void echoed(const Received& received);
  void decode(const Frame& frame, std::size_t index);
  checks::Observations seen_;
  std::optional<observe::Stopwatch> stopwatch_;
  Takers takers_;
  std::optional<ReceiverModel> model_;
  bool sent_any_ = false;
  bool in_handshake_ = false;  // with a target that was restarted in the flight
  std::array<e2e::Receiver, messages::all_messages.size()> receivers_{};
  std::array<checks::StimulusCount*, messages::all_messages.size()>
      stimuli_{};  // in seen_, by index of the message that closes the group; null: none was sent
  std::vector<std::unique_ptr<estimators::Reception>> receptions_;
  std::array<estimators::Reception*, messages::all_messages.size()>
      reception_of_{};       // by index in all_messages
  std::int64_t now_us_ = 0;  // time of the last Sync
};

}  // namespace canhil::protocol
