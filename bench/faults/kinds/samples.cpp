#include "bench/faults/kinds/samples.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/faults/faulty_node.hpp"
#include "bench/faults/frame_edit.hpp"
#include "bench/faults/measured_value.hpp"
#include "bench/observe/values.hpp"
#include "messages/canhil.hpp"

namespace canhil::faults {
namespace {

class WithSwapped final : public FaultyNode {
 public:
  WithSwapped(std::unique_ptr<nodes::Node> node, const scenario::NodeSettings& settings, const InRun& run,
              const Swapped& kind)
      : FaultyNode(std::move(node), settings, run),
        one_(kind.one.all.front()),
        other_(kind.other),
        occasions_(kind.when, run.stream()) {}

 private:
  void apply(std::vector<Frame>& frames, std::int64_t t_us) override {
    Frame *one = one_.in(frames), *other = other_.in(frames);
    if (one == nullptr || other == nullptr || !occasions_.next(t_us)) return;
    const double interval_s = interval_of(frames, period_us_);
    const double value = one_.get(*one, interval_s);
    one_.put(*one, other_.get(*other, interval_s), interval_s, clipped());
    other_.put(*other, value, interval_s, clipped());
    ++tally().count;
    ++tally().changed;
  }
  MeasuredValue one_, other_;
  Occasions occasions_;
};

class WithInvalid final : public FaultyNode {
 public:
  WithInvalid(std::unique_ptr<nodes::Node> node, const scenario::NodeSettings& settings, const InRun& run,
              const Invalid& kind)
      : FaultyNode(std::move(node), settings, run), flags_(kind.flags), occasions_(kind.when, run.stream()) {}

 private:
  void apply(std::vector<Frame>& frames, std::int64_t t_us) override {
    if (std::ranges::none_of(frames, [&](const Frame& frame) { return is_own(frame); })) return;
    if (!occasions_.next(t_us)) return;
    ++tally().count;
    for (const Measured& flag : flags_) {
      if (Frame* frame = MeasuredValue(flag).in(frames); frame != nullptr)
        set(*frame, flag.signal->name, static_cast<double>(messages::Validity::invalid));
    }
  }
  std::vector<Measured> flags_;
  Occasions occasions_;
};

std::vector<Measured> flags_of(const MessageInfo& message) {
  std::vector<Measured> flags;
  for (const SignalInfo* signal : observe::signals_of(message)) {
    if (is_validity(message, signal->name)) flags.push_back({.message = &message, .signal = signal});
  }
  return flags;
}

// The validity flags in this message. If the message has none, the validity flags in the other messages of
// its sample group.
std::vector<Measured> flags_for(const MessageInfo& message) {
  std::vector<Measured> flags = flags_of(message);
  if (!flags.empty()) return flags;
  for (const MessageInfo& other : messages::all_messages) {
    if (other.sample_group != message.sample_group || other.sender != message.sender) continue;
    const auto more = flags_of(other);
    flags.insert(flags.end(), more.begin(), more.end());
  }
  return flags;
}

}  // namespace

Swapped Swapped::read(scenario::Section& section, const scenario::FaultContext& context) {
  Swapped kind;
  const mapping::Stimulus* one = read_quantity(
      section, context, {"quantity", "First of the two quantities that are exchanged (faults.md)."});
  const mapping::Stimulus* other = read_quantity(
      section, context,
      {"with", "Second of the two quantities. It must have the same node and unit as the first."});
  kind.when = read_when(section, context, Repeats::each);
  if (one == nullptr || other == nullptr) return kind;
  if (one == other || one->si != other->si || one->node != other->node || one->over != other->over)
    section.reject("with", fmt::format("'{}' is not like '{}'", other->name, one->name),
                   "another quantity of the same node and unit");
  kind.one = {.all = {measured(*one)}, .text = one->name + " " + other->name};
  kind.other = measured(*other);
  return kind;
}

std::unique_ptr<nodes::Node> Swapped::with_fault(std::unique_ptr<nodes::Node> node,
                                                 const scenario::NodeSettings& settings,
                                                 const InRun& run) const {
  if (!sends(settings.table(), *other.message)) return node;
  return std::make_unique<WithSwapped>(std::move(node), settings, run, *this);
}

Invalid Invalid::read(scenario::Section& section, const scenario::FaultContext& context) {
  Invalid kind;
  std::string_view key = "quantity";
  if (section.has("node")) {
    key = "node";
    section.refuse("quantity", "is given beside node", "one of the two");
    const scenario::NodeTable* node = read_node(section, context);
    if (node != nullptr) {
      kind.text = node->key;
      for (const MessageInfo& message : messages::all_messages) {
        if (!sends(*node, message)) continue;
        const auto more = flags_of(message);
        kind.flags.insert(kind.flags.end(), more.begin(), more.end());
      }
    }
  } else {
    section.optional("node");
    const mapping::Stimulus* stimulus = read_quantity(
        section, context, {key, "Measured quantity whose validity flags are set to invalid (faults.md)."});
    if (stimulus != nullptr) {
      kind.text = stimulus->name;
      kind.flags = flags_for(*stimulus->message);
    }
  }
  if (kind.flags.empty()) section.reject(key, "has no validity flag", "one that has");
  kind.when = read_when(section, context, Repeats::each);
  return kind;
}

std::unique_ptr<nodes::Node> Invalid::with_fault(std::unique_ptr<nodes::Node> node,
                                                 const scenario::NodeSettings& settings,
                                                 const InRun& run) const {
  if (!sends(settings.table(), *flags.front().message)) return node;
  return std::make_unique<WithInvalid>(std::move(node), settings, run, *this);
}

}  // namespace canhil::faults
