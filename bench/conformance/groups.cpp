#include "bench/conformance/groups.hpp"

#include <algorithm>
#include <cmath>

#include "bench/observe/values.hpp"
#include "dbc/wire/bits.hpp"
#include "dbc/wire/e2e.hpp"
#include "messages/canhil.hpp"

namespace canhil::conformance {
namespace {

constexpr std::string_view time_of_validity = "time_of_validity_us";

const MessageInfo* info_of(const Frame& frame) { return messages::find_message(frame.id, frame.extended); }

bool closes_step(const Frame& frame) {
  return frame.id == messages::Sync::info.id || frame.id == messages::StepDone::info.id;
}

// Adds `steps` to the raw value of a signal, modulo the range of the signal. Assumes that the signal is
// little-endian: all time signals of canhil's DBC are.
void add_raw(Frame& frame, const SignalInfo& signal, std::int64_t steps) {
  const auto old = wire::load_le<0, 8>(frame.data.data());
  const std::uint64_t field = wire::mask(signal.length) << signal.start_bit;
  const std::uint64_t raw = (old & field) >> signal.start_bit;
  const std::uint64_t sum = (raw + static_cast<std::uint64_t>(steps)) << signal.start_bit;
  wire::store_le<0, 8>(frame.data.data(), (old & ~field) | (sum & field));
}

}  // namespace

std::optional<double> Group::value(std::string_view signal) const {
  for (const Frame& frame : frames) {
    for (const observe::Value& value : observe::values_of(frame)) {
      if (value.signal->name == signal) return value.value;
    }
  }
  return std::nullopt;
}

std::vector<std::uint32_t> ids_of(std::string_view group) {
  std::vector<std::uint32_t> ids;
  for (const MessageInfo& info : messages::all_messages) {  // all_messages is sorted by ascending id
    if (info.sample_group == group) ids.push_back(info.id);
  }
  return ids;
}

std::vector<Group> groups_in(std::span<const Frame> frames) {
  std::vector<Group> open, ended;
  std::size_t step = 0;
  for (const Frame& frame : frames) {
    if (closes_step(frame)) ++step;
    const MessageInfo* info = info_of(frame);
    if (info == nullptr || info->sample_group.empty()) continue;
    const auto ids = ids_of(info->sample_group);
    auto group = std::ranges::find(open, info->sample_group, &Group::name);
    if (group != open.end() &&
        std::ranges::find(group->frames, frame.id, &Frame::id) != group->frames.end()) {
      ended.push_back(std::move(*group));
      open.erase(group);
      group = open.end();
    }
    if (group == open.end()) group = open.insert(open.end(), Group{.name = info->sample_group, .frames = {}});
    group->frames.push_back(frame);
    group->counter = e2e::counter(frame.payload());
    group->step = step;
    if (frame.id != ids.back()) continue;
    ended.push_back(std::move(*group));
    open.erase(group);
  }
  return ended;
}

bool answers_something(std::string_view group) {
  return std::ranges::any_of(messages::all_messages, [&](const MessageInfo& info) {
    return info.sample_group == group && !info.answers.empty();
  });
}

bool answers(std::string_view answer, std::string_view sample) {
  return std::ranges::any_of(messages::all_messages, [&](const MessageInfo& info) {
    return info.sample_group == answer && std::ranges::find(info.answers, sample) != info.answers.end();
  });
}

void shift_time(Frame& frame, std::int64_t shift_us) {
  const MessageInfo* info = info_of(frame);
  if (info == nullptr || frame.size != info->size || frame.size != 8) return;
  const bool sync = frame.id == messages::Sync::info.id;
  const SignalInfo* signal = observe::signal_of(*info, sync ? "time_us" : time_of_validity);
  if (signal == nullptr) return;
  add_raw(frame, *signal, std::llround(static_cast<double>(shift_us) / signal->scale));
  e2e::protect({frame.data.data(), frame.size}, info->e2e_data_id, e2e::counter(frame.payload()));
}

}  // namespace canhil::conformance
