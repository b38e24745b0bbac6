// Rules about damaged, repeated and missing frames.
#include <fmt/format.h>

#include "bench/conformance/groups.hpp"
#include "bench/conformance/rules.hpp"

namespace canhil::conformance {
namespace {

using namespace messages;

constexpr double most_counted = 8191;  // the counters in TargetCounters saturate at this value

/// A function that appends to `instead` the frames that are sent in place of `frame`. `frame` is message k
/// (counted from 0) of the n messages of the sample.
using Spoil = void (*)(const Frame& frame, std::size_t k, std::size_t n, std::vector<Frame>& instead);

struct Seen {
  int answers = 0;  ///< number of answers to the damaged sample
  std::size_t messages = 0;
  TargetCounters counted;  ///< by how much each counter increased during the flight
  TargetHeartbeat beat;
};

// Flies, and applies `spoil` to one sample in mid-flight: a sample that the target answered in the
// undisturbed flight.
Result<Seen> flown_with(Subject& subject, Spoil spoil) {
  const auto known = undisturbed(subject);
  if (!known) return tl::unexpected(known.error());
  const Undisturbed& other = **known;
  const auto ids = ids_of(other.sample);
  if (auto wrong = made_to_run(subject); !wrong.empty()) return failure(wrong);
  std::size_t begun = 0;  // number of samples of this group that have begun so far
  subject.talk.fly(flight_us, [&](const Frame& frame, std::vector<Frame>& instead) {
    const auto place = std::ranges::find(ids, frame.id);
    if (place == ids.end() || frame.extended) return instead.push_back(frame);
    if (place == ids.begin()) ++begun;
    if (begun != other.index + 1) return instead.push_back(frame);
    spoil(frame, static_cast<std::size_t>(place - ids.begin()), ids.size(), instead);
  });
  const auto before = subject.talk.first_received<TargetCounters>();
  const auto after = subject.talk.last_received<TargetCounters>();
  const auto beat = subject.talk.last_received<TargetHeartbeat>();
  if (!before || !after || !beat) return failure("no counters or no heartbeat in flight");
  const auto more = [](std::uint16_t now, std::uint16_t then) {
    return static_cast<std::uint16_t>(now - then);
  };
  Seen seen{.messages = ids.size(),
            .counted = {.frames_lost = more(after->frames_lost, before->frames_lost),
                        .bad_crc = more(after->bad_crc, before->bad_crc),
                        .bad_group = more(after->bad_group, before->bad_group),
                        .late = more(after->late, before->late)},
            .beat = *beat};
  for (const Group& answer : groups_in(subject.talk.heard())) {
    if (answers(answer.name, other.sample) && answer.value("cause_time_us") == other.time_us) ++seen.answers;
  }
  return seen;
}

std::string unless(bool right, const Seen& seen, const char* expected) {
  if (right) return "";
  return fmt::format(
      "the sample is answered {} times; lost {}, bad CRC {}, bad groups {}, late {}; {}; expected {}",
      seen.answers, seen.counted.frames_lost, seen.counted.bad_crc, seen.counted.bad_group, seen.counted.late,
      described(seen.beat), expected);
}

// Damages the last message of the sample. A receiver may consider a group complete when the last message of
// the group arrives. If only another message were damaged, such a receiver might consider the sample
// complete.
std::string drops_a_wrong_crc(Subject& subject) {
  const auto seen = flown_with(subject, [](const Frame& frame, std::size_t k, std::size_t n, auto& instead) {
    instead.push_back(frame);
    if (k + 1 == n) instead.back().data[0] ^= 0x55U;
  });
  if (!seen) return seen.error().message;
  return unless(seen->answers == 0 && seen->counted.bad_crc == 1 && seen->beat.error_input_lost != 0, *seen,
                "no answer, bad CRC 1 and input_lost");
}

std::string drops_a_wrong_size(Subject& subject) {
  const auto seen = flown_with(subject, [](const Frame& frame, std::size_t k, std::size_t n, auto& instead) {
    instead.push_back(frame);
    if (k + 1 != n) return;
    --instead.back().size;
    const MessageInfo* info = find_message(frame.id, false);
    e2e::protect({instead.back().data.data(), instead.back().size}, info->e2e_data_id,
                 e2e::counter(frame.payload()));
  });
  if (!seen) return seen.error().message;
  return unless(seen->answers == 0 && seen->counted.bad_crc == 1, *seen, "no answer and bad CRC 1");
}

std::string drops_a_repetition(Subject& subject) {
  const auto seen = flown_with(subject, [](const Frame& frame, std::size_t k, std::size_t n, auto& instead) {
    instead.push_back(frame);
    if (k + 1 == n) instead.push_back(frame);
  });
  if (!seen) return seen.error().message;
  return unless(seen->answers == 1 && seen->counted.late == 1 && seen->counted.bad_group == 0, *seen,
                "one answer, late 1, bad groups 0");
}

std::string counts_what_is_lost(Subject& subject) {
  const auto seen = flown_with(subject, [](const Frame&, std::size_t, std::size_t, auto&) {});
  if (!seen) return seen.error().message;
  return unless(
      seen->answers == 0 && seen->counted.frames_lost == seen->messages && seen->beat.error_input_lost != 0,
      *seen, fmt::format("no answer, lost {} and input_lost", seen->messages).c_str());
}

std::string answers_no_half_sample(Subject& subject) {
  if (const auto known = undisturbed(subject); known && ids_of((*known)->sample).size() < 2) return "";
  const auto seen = flown_with(subject, [](const Frame& frame, std::size_t k, std::size_t, auto& instead) {
    if (k != 0) instead.push_back(frame);
  });
  if (!seen) return seen.error().message;
  return unless(seen->answers == 0 && seen->counted.bad_group >= 1, *seen, "no answer and a bad group");
}

std::string counts_to_the_end(Subject& subject) {
  if (auto wrong = flies(subject); !wrong.empty()) return wrong;
  subject.talk.send_damaged(static_cast<int>(most_counted) + 100);
  const auto counted = subject.talk.hear_in_flight<TargetCounters>(some_flight_us);
  if (!counted) return "no counters in flight";
  return counted->bad_crc == most_counted
             ? ""
             : fmt::format("{} damaged frames: {} are counted", most_counted + 100, counted->bad_crc);
}

constexpr Rule all[] = {
    {"P-CRC", "protocol", "A frame with a wrong CRC is dropped and counted in bad_crc.", drops_a_wrong_crc},
    {"P-SIZE", "protocol", "A frame of another size is dropped and counted in bad_crc.", drops_a_wrong_size},
    {"P-TWICE", "protocol", "A frame with the counter of the one before is dropped and counted in late.",
     drops_a_repetition},
    {"P-LOST", "protocol", "Frames that are missing by their counters are counted in frames_lost.",
     counts_what_is_lost},
    {"P-HALF", "protocol",
     "A sample of which a message is missing is counted in bad_group and is not answered.",
     answers_no_half_sample},
    {"P-COUNT", "protocol", "Counters of losses stay at their largest value.", counts_to_the_end},
};

}  // namespace

std::span<const Rule> fault_rules() { return all; }

}  // namespace canhil::conformance
