// Wrong measurements of a sensor: the sample is sent in time, with a valid counter and CRC. A value is either
// the value of a quantity, in SI, or the value of a signal, in the unit of the signal.
#pragma once

#include <functional>
#include <optional>

#include "bench/faults/read.hpp"
#include "bench/faults/rule.hpp"

namespace canhil::faults {

/// What the wrong value may depend on, besides the correct value.
struct Sampled {
  std::int64_t since_us = 0;    ///< time since the start of the fault
  std::optional<double>& held;  ///< a value that the kind remembers; empty again when the fault is not active
  world::Stream& noise;
};
using Becomes = std::function<double(double value, const Sampled& sample)>;

/// Whether some of these values are measured by this sensor.
bool act_on(const OfValues& of, const scenario::NodeTable& sensor);
/// Wraps a sensor in a fault that changes the values named by `of`.
std::unique_ptr<sensors::Sensor> with_values(std::unique_ptr<sensors::Sensor> sensor,
                                             const scenario::NodeSettings& settings, const InRun& run,
                                             const OfValues& of, const When& when, Becomes becomes);

/// The part that all kinds in this file share. The function `becomes` of a kind computes the faulty value.
template <class Kind>
struct EachValue {
  static constexpr Stage stage = Stage::sensor;
  OfValues of{};
  When when{};
  double size = 0;
  static Kind read(scenario::Section& section, const scenario::FaultContext& context) {
    Kind kind;
    kind.of = read_values(section, context);
    kind.when = read_when(section, context, Repeats::each);
    if constexpr (requires { Kind::stem; })
      kind.size = read_size(section, Kind::stem, Kind::size_meaning, kind.of, Kind::limits);
    if constexpr (requires { kind.check(section); }) kind.check(section);
    return kind;
  }
  [[nodiscard]] std::string subject() const { return of.text; }
  [[nodiscard]] bool acts_on(const scenario::NodeTable& sensor) const { return act_on(of, sensor); }
  [[nodiscard]] std::unique_ptr<sensors::Sensor> with_fault(std::unique_ptr<sensors::Sensor> sensor,
                                                            const scenario::NodeSettings& settings,
                                                            const InRun& run) const {
    return with_values(
        std::move(sensor), settings, run, of, when,
        [size = size](double value, const Sampled& sample) { return Kind::becomes(value, size, sample); });
  }
};

/// The value is replaced.
struct Changed : EachValue<Changed> {
  static constexpr std::string_view kind = "changed", stem = "value", size_meaning = "New value.";
  static constexpr std::string_view meaning =
      "The sensor's value is replaced by `value_UNIT`. A flag is replaced by 0 or 1.";
  static constexpr scenario::Limits limits{};
  void check(scenario::Section& section) const;
  static double becomes(double /*value*/, double size, const Sampled& /*sample*/) { return size; }
};

/// A constant offset.
struct Bias : EachValue<Bias> {
  static constexpr std::string_view kind = "bias", stem = "by", size_meaning = "Offset.";
  static constexpr std::string_view meaning = "`by_UNIT` is added to the sensor's value.";
  static constexpr scenario::Limits limits{};
  static double becomes(double value, double size, const Sampled& /*sample*/) { return value + size; }
};

/// An offset that grows at a constant rate.
struct Drift : EachValue<Drift> {
  static constexpr std::string_view kind = "drift", stem = "by",
                                    size_meaning = "Growth of the offset per second.";
  static constexpr std::string_view meaning =
      "`by_UNIT` is added to the sensor's value for each second since `from_s`.";
  static constexpr scenario::Limits limits{};
  static double becomes(double value, double size, const Sampled& sample) {
    return value + size * 1e-6 * static_cast<double>(sample.since_us);
  }
};

/// Single samples have an offset.
struct Spike : EachValue<Spike> {
  static constexpr std::string_view kind = "spike", stem = "by", size_meaning = "Offset.";
  static constexpr std::string_view meaning =
      "As `bias`, but only single samples are changed. Needs `every` above 1 or `percent` below 100.";
  static constexpr scenario::Limits limits{};
  void check(scenario::Section& section) const;
  static double becomes(double value, double size, const Sampled& /*sample*/) { return value + size; }
};

/// The value stays as it was at the start of the fault.
struct Stuck : EachValue<Stuck> {
  static constexpr std::string_view kind = "stuck";
  static constexpr std::string_view meaning = "The sensor's value stays as it was at the start of the fault.";
  static double becomes(double value, double size, const Sampled& sample);
};

/// The magnitude of the value is limited.
struct Saturated : EachValue<Saturated> {
  static constexpr std::string_view kind = "saturated", stem = "at", size_meaning = "Largest magnitude.";
  static constexpr std::string_view meaning = "The magnitude of the sensor's value is limited to `at_UNIT`.";
  static constexpr scenario::Limits limits = {.least = 0};
  static double becomes(double value, double size, const Sampled& sample);
};

/// Additional white noise, 1-sigma per sample.
struct Noise : EachValue<Noise> {
  static constexpr std::string_view kind = "noise", stem = "sigma", size_meaning = "1-sigma of a sample.";
  static constexpr std::string_view meaning =
      "White noise is added to the sensor's value: 1-sigma of a sample is `sigma_UNIT`.";
  static constexpr scenario::Limits limits = {.least = 0};
  static double becomes(double value, double size, const Sampled& sample) {
    return value + size * sample.noise.normal();
  }
};

/// The sign of the value is reversed.
struct Reversed : EachValue<Reversed> {
  static constexpr std::string_view kind = "reversed";
  static constexpr std::string_view meaning = "The sign of the sensor's value is reversed.";
  static double becomes(double value, double /*size*/, const Sampled& /*sample*/) { return -value; }
};

}  // namespace canhil::faults
