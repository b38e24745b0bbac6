// What one run leaves behind for a campaign: samples in order of time, each a number for every quantity of a
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

/// A quantity that follows from those that are kept.
struct Derived {
  const Quantity* quantity = nullptr;
  double (*of)(const Samples& samples, std::size_t index) = nullptr;
};

/// What the samples of an estimator hold. Errors are signed (estimated - true), in SI. Any may be NaN or
/// infinite, as the target sent it; normalised errors squared that are no numbers are infinite.
struct Layout {
  std::span<const Quantity* const> kept{};
  std::span<const Derived> derived{};
  /// Samples are stretches of the time to go of this length, and their times are minus that at which a
  /// stretch begins, so that the closest approach is at 0. 0: a sample is an answer, at its time of validity.
  std::int64_t to_go_stretch_us = 0;
  const Quantity* end_known_by = nullptr;  ///< NaN in the last sample: when the flight ends is not known
  bool answers_untold = false;  ///< a sample that does not tell a quantity is an answer that had no reason to
};

/// Whether samples of a layout tell a quantity.
bool has(const Layout& layout, const Quantity& quantity);

/// Of those that are kept, in their order: "wind.along wind.cross ...".
std::string names(const Layout& layout);

class Samples {
 public:
  Samples() = default;
  /// `layout` must outlive the samples: it is an estimator's.
  explicit Samples(const Layout& layout) : layout_(&layout) {}

  /// `values`: of layout().kept.
  void add(std::int64_t t_us, std::span<const double> values);

  [[nodiscard]] const Layout& layout() const { return *layout_; }
  [[nodiscard]] std::size_t size() const { return t_us_.size(); }
  [[nodiscard]] bool empty() const { return t_us_.empty(); }
  [[nodiscard]] std::span<const std::int64_t> times() const { return t_us_; }
  /// Of a sample, by its place; NaN: the layout does not tell it.
  [[nodiscard]] double value(std::size_t index, const Quantity& quantity) const;
  /// The numbers kept of a sample.
  [[nodiscard]] std::span<const double> values(std::size_t index) const;

 private:
  static constexpr Layout nothing{};
  const Layout* layout_ = &nothing;
  std::vector<std::int64_t> t_us_;
  std::vector<double> values_;  // sample by sample
};

/// A normalised error squared that was told: infinite where it is no number, so that NaN is left to what was
/// not told.
double infinite_if_nan(double normalised);

/// Samples as bytes: doubles, little endian: t in s and what is kept, sample by sample.
std::vector<std::uint8_t> encode(const Samples& samples);
/// Error: in which way the bytes are no samples of the layout.
Result<Samples> decode(std::span<const std::uint8_t> bytes, const Layout& layout);

}  // namespace canhil::quantities
