#include "bench/faults/sensors/samples.hpp"

#include <fmt/format.h>

#include "bench/faults/sensors/faulty_sensor.hpp"
#include "bench/scenario/binding.hpp"

namespace canhil::faults {
namespace {

class WithSwapped final : public FaultySensor {
 public:
  WithSwapped(std::unique_ptr<sensors::Sensor> sensor, const scenario::NodeSettings& settings,
              const InRun& run, const Swapped& kind)
      : FaultySensor(std::move(sensor), run),
        kind_(kind),
        period_us_(settings.period_us()),
        occasions_(run.in(kind.when), run.stream()) {}

 private:
  void change(sensors::Sample& sample, std::int64_t t_us) override {
    if (!occasions_.next(t_us)) return;
    const double one = kind_.one.get(sample, period_us_), other = kind_.other.get(sample, period_us_);
    if (one == other) return;
    kind_.one.put(sample, period_us_, other);
    kind_.other.put(sample, period_us_, one);
    ++tally().count;
    ++tally().changed;
  }
  Swapped kind_;
  std::int64_t period_us_;
  Occasions occasions_;
};

class WithInvalid final : public FaultySensor {
 public:
  WithInvalid(std::unique_ptr<sensors::Sensor> sensor, const InRun& run, const Invalid& kind)
      : FaultySensor(std::move(sensor), run),
        flags_(kind.flags),
        occasions_(run.in(kind.when), run.stream()) {}

 private:
  void change(sensors::Sample& sample, std::int64_t t_us) override {
    if (!occasions_.next(t_us) || (sample.invalid & flags_) == flags_) return;
    ++tally().count;
    sample.invalid |= flags_;
  }
  std::uint32_t flags_;
  Occasions occasions_;
};

}  // namespace

Swapped Swapped::read(scenario::Section& section, const scenario::FaultContext& context) {
  Swapped kind;
  const sensors::Measurand* one = read_quantity(
      section, context, {"quantity", "First of the two quantities that are exchanged (faults.md)."});
  const sensors::Measurand* other = read_quantity(
      section, context,
      {"with", "Second of the two quantities. It must have the same node and unit as the first."});
  kind.when = read_when(section, context, Repeats::each);
  if (one == nullptr || other == nullptr) return kind;
  if (one == other || one->si != other->si || one->sensor != other->sensor || one->over != other->over)
    section.reject("with", fmt::format("'{}' is not like '{}'", other->name, one->name),
                   "another quantity of the same node and unit");
  expect_carried(section, context, "quantity", *one);
  expect_carried(section, context, "with", *other);
  kind.one = measured(*one);
  kind.other = measured(*other);
  kind.text = one->name + " " + other->name;
  return kind;
}

std::unique_ptr<sensors::Sensor> Swapped::with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                     const scenario::NodeSettings& settings,
                                                     const InRun& run) const {
  return std::make_unique<WithSwapped>(std::move(sensor), settings, run, *this);
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
      kind.of = &sensor_of(*node);
      kind.flags = (1U << kind.of->outputs.flags.size()) - 1;
    }
  } else {
    section.optional("node");
    const sensors::Measurand* measurand = read_quantity(
        section, context, {key, "Measured quantity whose validity flags are set to invalid (faults.md)."});
    if (measurand != nullptr) {
      kind.text = measurand->name;
      kind.of = measurand->sensor;
      if (!kind.of->outputs.flags.empty()) kind.flags = measurand->output().flags;
    }
  }
  if (kind.flags == 0) {
    section.reject(key, "has no validity flag", "one that has");
  } else if ((context.contract.binding->carried(*kind.of).flags & kind.flags) == 0) {
    section.reject(key, "has a validity that no message of the bench carries",
                   "one with an entry in [play.invalid] of the mapping");
  }
  kind.when = read_when(section, context, Repeats::each);
  return kind;
}

std::unique_ptr<sensors::Sensor> Invalid::with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                     const scenario::NodeSettings& /*settings*/,
                                                     const InRun& run) const {
  return std::make_unique<WithInvalid>(std::move(sensor), run, *this);
}

}  // namespace canhil::faults
