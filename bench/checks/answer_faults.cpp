#include "bench/checks/answer_faults.hpp"

#include <fmt/format.h>

#include <map>
#include <vector>

namespace canhil::checks {
namespace {

// The indices of the messages of each answer group, in the order of transmission.
std::map<std::string_view, std::vector<std::size_t>> groups_of_answers(const Observations& seen) {
  std::map<std::string_view, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < seen.timing.messages.size(); ++i) {
    const MessageInfo& info = seen.timing.messages[i];
    if (!info.sample_group.empty() && !info.answers.empty()) groups[info.sample_group].push_back(i);
  }
  return groups;
}

void append(std::string& line, const std::string& part) { line += (line.empty() ? "" : "; ") + part; }

std::string wrong_causes(const AnswerTiming& timing) {
  std::string line;
  if (timing.unpaired > 0) {
    append(line, fmt::format("{} answers with no cause", timing.unpaired));
    line += timing.nearest_us ? fmt::format(", nearest {} us off", *timing.nearest_us)
                              : std::string(", as nothing was sent that they answer");
  }
  if (timing.wrong_counter > 0)
    append(line,
           fmt::format("{} answers with the counter of another cause than that of their time, first {}, "
                       "expected {}",
                       timing.wrong_counter, timing.counter_reported, timing.counter_sent));
  return line;
}

// Explains why the messages of a group never formed a whole group.
std::string to_blame(const Observations& seen, const std::vector<std::size_t>& group) {
  std::string line;
  for (const std::size_t index : group) {
    const Sighting& sighting = seen.from_target[index];
    if (sighting.right > 0) continue;
    const MessageInfo& info = seen.timing.messages[index];
    const std::string faults = faults_of(sighting, info);
    line += fmt::format("{}{}{}", line.empty() ? "" : ", ", info.name,
                        faults.empty() ? " missing" : ": " + faults);
  }
  return line.empty() ? "its messages never have one counter" : line;
}

}  // namespace

std::string wrong_causes(const Observations& seen) {
  std::string line;
  for (const auto& [group, indices] : groups_of_answers(seen)) {
    if (std::string wrong = wrong_causes(seen.timing.answers[indices.back()]); !wrong.empty())
      append(line, fmt::format("{}: {}", group, wrong));
  }
  return line;
}

std::string broken_groups(const Observations& seen) {
  std::string line;
  for (const auto& [group, indices] : groups_of_answers(seen)) {
    std::uint64_t frames = 0;
    for (const std::size_t index : indices) frames += seen.from_target[index].right;
    if (frames == 0 || seen.answers[indices.back()] > 0) continue;
    append(line, fmt::format("{}: {} frames and no whole group: {}", group, frames, to_blame(seen, indices)));
  }
  return line;
}

}  // namespace canhil::checks
