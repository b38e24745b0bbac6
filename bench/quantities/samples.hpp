// The samples that a run contributes to a campaign, in order of time. A sample has one number for each
// quantity of a layout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/quantities/quantity.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::quantities {

class Samples;

/// A quantity that is computed from the stored quantities.
struct Derived {
  const Quantity* quantity = nullptr;
  double (*of)(const Samples& samples, std::size_t index) = nullptr;
};

/// Describes what a sample of an estimator contains. Errors are signed (estimated - true), in SI. A value may
/// be NaN or infinite if the target sent such a value. A normalised error squared that is NaN is stored as
/// infinite.
struct Layout {
  std::span<const Quantity* const> kept{};
  std::span<const Derived> derived{};
  /// If to_go_stretch_us is positive, each sample covers an interval of the time to go, and the interval has
  /// this length. The time of the sample is then minus the time to go at the start of the interval, so the
  /// closest approach is at time 0. If to_go_stretch_us is 0, a sample is one answer, and its time is the
  /// answer's time of validity.
  std::int64_t to_go_stretch_us = 0;
  const Quantity* end_known_by = nullptr;  ///< if this quantity is NaN in the last sample, the end of the
                                           ///< flight is unknown
  bool answers_may_omit = false;           ///< true: an answer may omit a quantity
};

/// Whether samples of a layout contain a quantity.
bool has(const Layout& layout, const Quantity& quantity);

/// The names of the stored quantities, in the order in which they are stored: "wind.along wind.cross ...".
std::string names(const Layout& layout);

class Samples {
 public:
  Samples() = default;
  /// The layout belongs to an estimator and must outlive the samples.
  explicit Samples(const Layout& layout) : layout_(&layout) {}

  /// `values` contains one value for each quantity of layout().kept, in the order of `kept`.
  void add(std::int64_t t_us, std::span<const double> values);

  [[nodiscard]] const Layout& layout() const { return *layout_; }
  [[nodiscard]] std::size_t size() const { return t_us_.size(); }
  [[nodiscard]] bool empty() const { return t_us_.empty(); }
  [[nodiscard]] std::span<const std::int64_t> times() const { return t_us_; }
  /// The value of a quantity in the sample `index`; NaN if the layout does not contain the quantity.
  [[nodiscard]] double value(std::size_t index, const Quantity& quantity) const;
  /// The stored numbers of the sample `index`.
  [[nodiscard]] std::span<const double> values(std::size_t index) const;

 private:
  static constexpr Layout nothing{};
  const Layout* layout_ = &nothing;
  std::vector<std::int64_t> t_us_;
  std::vector<double> values_;  // the values of the first sample, then those of the second sample, and so on
};

/// `normalised` is a normalised error squared. Returns infinity if it is NaN (the target did not report it),
/// otherwise `normalised` itself.
double infinite_if_nan(double normalised);

/// Converts samples to bytes. Each sample becomes little-endian doubles: its time in s, then its stored
/// values.
std::vector<std::uint8_t> encode(const Samples& samples);
/// The reverse of encode(). The error states why the bytes are not samples of the layout.
Result<Samples> decode(std::span<const std::uint8_t> bytes, const Layout& layout);

}  // namespace canhil::quantities
