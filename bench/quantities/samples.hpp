// The samples that a run contributes to a campaign, in order of time: one number for each quantity of a
// layout.
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

/// A quantity computed from the stored ones.
struct Derived {
  const Quantity* quantity = nullptr;
  double (*of)(const Samples& samples, std::size_t index) = nullptr;
};

/// The contents of an estimator's samples. Errors are signed (estimated - true), in SI. A value may be NaN or
/// infinite if the target sent it so; a normalised error squared that is NaN is stored as infinite.
struct Layout {
  std::span<const Quantity* const> kept{};
  std::span<const Derived> derived{};
  /// If positive, a sample covers an interval of this length in time to go. Its time is minus the time to go
  /// at the start of the interval, so the closest approach is at 0. If 0, a sample is one answer, at the
  /// answer's time of validity.
  std::int64_t to_go_stretch_us = 0;
  const Quantity* end_known_by = nullptr;  ///< if this quantity is NaN in the last sample, the end of the
                                           ///< flight is unknown
  bool answers_may_omit = false;           ///< an answer may omit a quantity that it does not need
};

/// Whether samples of a layout contain a quantity.
bool has(const Layout& layout, const Quantity& quantity);

/// The stored quantities in their order: "wind.along wind.cross ...".
std::string names(const Layout& layout);

class Samples {
 public:
  Samples() = default;
  /// `layout` must outlive the samples; it belongs to an estimator.
  explicit Samples(const Layout& layout) : layout_(&layout) {}

  /// `values`: one for each quantity of layout().kept, in its order.
  void add(std::int64_t t_us, std::span<const double> values);

  [[nodiscard]] const Layout& layout() const { return *layout_; }
  [[nodiscard]] std::size_t size() const { return t_us_.size(); }
  [[nodiscard]] bool empty() const { return t_us_.empty(); }
  [[nodiscard]] std::span<const std::int64_t> times() const { return t_us_; }
  /// The value in a sample; NaN: the layout does not contain the quantity.
  [[nodiscard]] double value(std::size_t index, const Quantity& quantity) const;
  /// The stored numbers of a sample.
  [[nodiscard]] std::span<const double> values(std::size_t index) const;

 private:
  static constexpr Layout nothing{};
  const Layout* layout_ = &nothing;
  std::vector<std::int64_t> t_us_;
  std::vector<double> values_;  // one sample after the other
};

/// A normalised error squared as reported: infinite if it is NaN, because NaN means "not reported".
double infinite_if_nan(double normalised);

/// Samples as bytes: little-endian doubles; for each sample t in s, then the stored values.
std::vector<std::uint8_t> encode(const Samples& samples);
/// Error: why the bytes are not samples of the layout.
Result<Samples> decode(std::span<const std::uint8_t> bytes, const Layout& layout);

}  // namespace canhil::quantities
