#include "bench/report/frames_around.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/drive/kept_frames.hpp"
#include "bench/recordings/frame_decoder.hpp"
#include "bench/recordings/message_finder.hpp"
#include "bench/scenario/binding.hpp"

namespace canhil::report {
namespace {

using nlohmann::ordered_json;
using recordings::MessageFinder;

// Enough for the samples before the worst one, its own frames, and the answer to them.
constexpr std::size_t most_before = 10, most_after = 30;

class FramesAround {
 public:
  FramesAround(const scenario::Binding& binding, const drive::KeptFrames& kept) : kept_(kept) {
    for (const dbc::Database* database : binding.databases()) finders_.emplace_back(*database, false);
  }

  ordered_json at(std::int64_t t_us) {
    const std::size_t middle = kept_.first_from(t_us);
    const std::size_t end = std::min(kept_.size(), middle + most_after);
    ordered_json frames = ordered_json::array();
    for (std::size_t i = middle - std::min(middle, most_before); i < end; ++i)
      frames.push_back(frame(kept_[i]));
    return frames;
  }

 private:
  ordered_json frame(const drive::KeptFrames::Kept& kept) {
    const Frame& frame = kept.frame;
    ordered_json json{{"t_s", static_cast<double>(kept.t_us) / 1e6},
                      {"transmitted", kept.transmitted},
                      {"id", frame.id},
                      {"extended", frame.extended},
                      {"bytes", fmt::format("{:02X}", fmt::join(frame.payload(), " "))}};
    if (frame.error) json["error"] = true;
    const dbc::Message* message = frame.error ? nullptr : message_of(frame);
    if (message == nullptr) return json;
    json["message"] = message->name;
    // A fast packet is a part of a message.
    if (!message->fast_packet) json["signals"] = signals(*message, frame);
    return json;
  }

  [[nodiscard]] const dbc::Message* message_of(const Frame& frame) const {
    for (const MessageFinder& finder : finders_) {
      const auto found = finder.find(frame);
      if (found.match == MessageFinder::Match::found) return found.message;
    }
    return nullptr;
  }

  // Each as its name, its value (null: it is not in the frame, or not a number) and its unit or the name of
  // the value.
  ordered_json signals(const dbc::Message& message, const Frame& frame) {
    ordered_json all = ordered_json::array();
    for (const recordings::SignalValue& value : decoder_.decode(message, frame.payload())) {
      const dbc::Signal& signal = message.signals[value.index];
      ordered_json number = ordered_json::parse(value.text, nullptr, false);
      if (!number.is_number()) number = nullptr;
      all.push_back(ordered_json::array(
          {signal.name, std::move(number), value.name.empty() ? signal.unit : std::string(value.name)}));
    }
    return all;
  }

  const drive::KeptFrames& kept_;
  std::vector<MessageFinder> finders_;
  recordings::FrameDecoder decoder_;
};

}  // namespace

ordered_json frames_around_worst(const scenario::Scenario& scenario, const drive::Run& run) {
  FramesAround around(*scenario.binding, *run.frames);
  ordered_json all = ordered_json::array();
  for (const checks::CheckResult& check : run.verdict.checks) {
    const auto& worst_us = check.judgement.measurement.worst_at_us;
    if (worst_us) all.push_back({{"check", check.name}, {"frames", around.at(*worst_us)}});
  }
  return all;
}

}  // namespace canhil::report
