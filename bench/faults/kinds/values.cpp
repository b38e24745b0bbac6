#include "bench/faults/kinds/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/faults/faulty_node.hpp"
#include "bench/faults/frame_edit.hpp"
#include "bench/faults/measured_value.hpp"

namespace canhil::faults {
namespace {

class WithValues final : public FaultyNode {
 public:
  WithValues(std::unique_ptr<nodes::Node> node, const scenario::NodeSettings& settings, const InRun& run,
             const OfValues& of, const When& when, Becomes becomes, bool exactly)
      : FaultyNode(std::move(node), settings, run),
        when_(when),
        becomes_(std::move(becomes)),
        exactly_(exactly) {
    for (const Measured& one : of.all)
      own_.push_back({.value = MeasuredValue(one),
                      .occasions = Occasions(when, run.stream(one.message->name)),
                      .noise = run.stream(std::string(one.message->name) + ".noise")});
  }

 private:
  struct Own {
    MeasuredValue value;
    Occasions occasions;
    world::Stream noise;
    std::optional<double> held{};
  };

  void apply(std::vector<Frame>& frames, std::int64_t t_us) override {
    for (Own& own : own_) {
      Frame* frame = own.value.in(frames);
      if (frame == nullptr) continue;
      if (!when_.holds(t_us)) own.held.reset();
      if (!own.occasions.next(t_us)) continue;
      const double interval_s = interval_of(frames, period_us_);
      const double value = becomes_(own.value.get(*frame, interval_s),
                                    {.since_us = t_us - when_.from_us, .held = own.held, .noise = own.noise});
      if (exactly_)
        own.value.put_exactly(*frame, value, interval_s);
      else
        own.value.put(*frame, value, interval_s, clipped());
      ++tally().count;
      ++tally().changed;
      if (is_time(own.value.of().signal->name)) ++tally().changed_times;
    }
  }

  When when_;
  Becomes becomes_;
  bool exactly_;
  std::vector<Own> own_;
};

}  // namespace

std::unique_ptr<nodes::Node> with_values(std::unique_ptr<nodes::Node> node,
                                         const scenario::NodeSettings& settings, const InRun& run,
                                         const OfValues& of, const When& when, Becomes becomes,
                                         bool exactly) {
  const bool has_one =
      std::ranges::any_of(of.all, [&](const Measured& one) { return sends(settings.table(), *one.message); });
  if (!has_one) return node;
  return std::make_unique<WithValues>(std::move(node), settings, run, of, when, std::move(becomes), exactly);
}

void Changed::check(scenario::Section& section) const {
  for (const Measured& one : of.all) {
    if (!one.si.empty() || (size >= one.signal->minimum && size <= one.signal->maximum)) continue;
    section.reject("value", fmt::format("{} of {} is {:g}", one.signal->name, one.message->name, size),
                   fmt::format("{:g} to {:g}", one.signal->minimum, one.signal->maximum));
  }
}

void Spike::check(scenario::Section& section) const {
  if (when.every > 1 || when.share < 1) return;
  section.reject("every", "is missing: a spike at each sample is a bias",
                 "every above 1, or percent below 100");
}

double Stuck::becomes(double value, double /*size*/, const Sampled& sample) {
  if (!sample.held) sample.held = value;
  return *sample.held;
}

double Saturated::becomes(double value, double size, const Sampled& /*sample*/) {
  return std::clamp(value, -size, size);
}

}  // namespace canhil::faults
