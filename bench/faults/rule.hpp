// The interface of a kind of fault to the rest of the bench.
//
// A kind is a struct with the constants `kind`, `meaning` (for `hil-bench reference`) and `stage`, with
// fields, among them `When when`, and with these functions:
//   static Kind read(scenario::Section&, const scenario::FaultContext&)
//   std::string subject() const                  what the fault affects, to distinguish faults of one kind
// for faults of a sensor or a node
//   bool acts_on(const scenario::NodeTable&) const                 whether it affects this sensor
//   std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor>,
//   const scenario::NodeSettings&, const InRun&) const             the wrapped sensor
// for faults of the bus or the target
//   std::unique_ptr<Injector> injector(const InRun&) const
// and, if the kind does not work in every run,
//   std::string cannot(const Place&) const       why it does not work, as text after "KIND "; empty: it works
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "bench/faults/injector.hpp"
#include "bench/faults/place.hpp"
#include "bench/faults/when.hpp"
#include "bench/scenario/faults.hpp"
#include "bench/sensors/kind.hpp"

namespace canhil::faults {

/// The stage of the data path at which a fault acts.
enum class Stage : std::uint8_t { sensor, node, bus, target };
constexpr std::string_view name(Stage stage) {
  constexpr std::array<std::string_view, 4> names{"sensor", "node", "bus", "target"};
  return names[static_cast<std::size_t>(stage)];
}

class Rule {
 public:
  Rule() = default;
  Rule(const Rule&) = delete;
  Rule& operator=(const Rule&) = delete;
  virtual ~Rule() = default;

  [[nodiscard]] virtual Stage stage() const = 0;
  [[nodiscard]] virtual const When& when() const = 0;
  [[nodiscard]] virtual std::string cannot(const Place& place) const = 0;
  /// The injector of the fault; null if the fault acts on samples.
  [[nodiscard]] virtual std::unique_ptr<Injector> injector(const InRun& run) const = 0;
  /// Whether the fault acts on the samples of this sensor.
  [[nodiscard]] virtual bool acts_on(const scenario::NodeTable& sensor) const = 0;
  /// Wraps a sensor on which the fault acts.
  [[nodiscard]] virtual std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                                    const scenario::NodeSettings& settings,
                                                                    const InRun& run) const = 0;
};

template <class Kind>
class RuleOf final : public Rule {
 public:
  explicit RuleOf(Kind kind) : kind_(std::move(kind)) {}
  [[nodiscard]] Stage stage() const override { return Kind::stage; }
  [[nodiscard]] const When& when() const override { return kind_.when; }
  [[nodiscard]] std::string cannot(const Place& place) const override {
    if constexpr (requires { kind_.cannot(place); }) return kind_.cannot(place);
    return {};
  }
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const override {
    if constexpr (requires { kind_.injector(run); }) return kind_.injector(run);
    return nullptr;
  }
  [[nodiscard]] bool acts_on(const scenario::NodeTable& sensor) const override {
    if constexpr (requires { kind_.acts_on(sensor); }) return kind_.acts_on(sensor);
    return false;
  }
  [[nodiscard]] std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                            const scenario::NodeSettings& settings,
                                                            const InRun& run) const override {
    if constexpr (requires { kind_.with_fault(std::move(sensor), settings, run); })
      return kind_.with_fault(std::move(sensor), settings, run);
    return sensor;
  }

 private:
  Kind kind_;
};

template <class Kind>
scenario::FaultRead read_rule(scenario::Section& section, const scenario::FaultContext& context) {
  Kind rule = Kind::read(section, context);
  const When when = rule.when;
  std::string subject;
  if constexpr (requires { rule.subject(); }) subject = rule.subject();
  return {.rule = std::make_shared<RuleOf<Kind>>(std::move(rule)),
          .from_us = when.from_us,
          .to_us = when.begins_in_run() ? Trigger::never_us : when.to_us,
          .begins_in_run = when.begins_in_run(),
          .subject = std::move(subject)};
}

/// The entry of a kind in the list of all kinds.
struct Listed {
  scenario::FaultKind kind;
  Stage stage;
};
template <class Kind>
inline constexpr Listed listed{
    .kind = {.name = Kind::kind, .meaning = Kind::meaning, .read = read_rule<Kind>}, .stage = Kind::stage};

}  // namespace canhil::faults
