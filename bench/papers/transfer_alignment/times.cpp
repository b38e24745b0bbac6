#include "bench/papers/transfer_alignment/times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace canhil::papers::transfer_alignment {
namespace {

constexpr double mrad = 1e-3;
constexpr double diverged_mrad = 20;
constexpr double acceleration_begins_s = 10;
constexpr std::array entries{&Times::within_3_mrad, &Times::within_2_mrad, &Times::within_1_mrad};

// Whether two times of one filter agree, although they were computed from different runs. The RMS of n runs
// has a relative sigma of 1 / sqrt(2 n), and the heading error is proportional to the power -p of (t - 10 s).
// Therefore a time has the sigma (t - 10 s) / (p sqrt(2 n)). From 3 to 2 mrad, p is 1.5: then three sigmas of
// the difference between the times of 300 runs and of 150 runs are 15 % of (t - 10 s). At 1 mrad the curves
// are flat; there, the spread over batches of 30 runs gives 35 %. One update interval is added to the
// permitted difference. "Never" agrees with any time from 18 s on, because the times of batches ranged from
// 18.9 s to never.
bool close(double ours, double reference, double part, double step_s) {
  constexpr double as_good_as_never_s = 18;
  if (std::isinf(ours) || std::isinf(reference)) return std::min(ours, reference) >= as_good_as_never_s;
  return std::abs(ours - reference) <=
         step_s + part * (std::min(ours, reference) - acceleration_begins_s) + 1e-6;
}

}  // namespace

Times times_of(std::span<const CurvePoint> curve) {
  const auto at = [&](double within) { return campaign::time_within(curve, within).value_or(never); };
  return {.within_3_mrad = at(3 * mrad),
          .within_2_mrad = at(2 * mrad),
          .within_1_mrad = at(1 * mrad),
          .end_mrad = curve.empty() ? std::nan("") : curve.back().rms / mrad};
}

Times times_in(std::string text) {
  Times times;
  if (text == "diverges") {
    times.end_mrad = std::nan("");
    return times;
  }
  std::erase(text, ' ');
  for (const auto entry : entries) {
    const std::string word = text.substr(0, text.find('/'));
    text.erase(0, word.size() + 1);
    times.*entry = word == "never" ? never : std::stod(word);
  }
  return times;
}

std::string time_words(double t_s) { return std::isfinite(t_s) ? fmt::format("{:.1f}", t_s) : "never"; }

std::string words_of(const Times& times) {
  if (std::isnan(times.end_mrad)) return "diverges";
  if (diverged(times)) return fmt::format("diverges ({:.0f} mrad at the end)", times.end_mrad);
  return fmt::format("{} / {} / {}", time_words(times.within_3_mrad), time_words(times.within_2_mrad),
                     time_words(times.within_1_mrad));
}

bool diverged(const Times& times) { return !(times.end_mrad < diverged_mrad); }

bool agrees(std::span<const CurvePoint> curve, const Times& reference, std::uint64_t runs) {
  const Times ours = times_of(curve);
  if (diverged(ours) || diverged(reference)) return diverged(ours) && diverged(reference);
  const double step_s = static_cast<double>(curve[1].t_us - curve[0].t_us) * 1e-6;
  const double fewer = std::sqrt((1.0 / static_cast<double>(runs) + 1.0 / 150) / (1.0 / 300 + 1.0 / 150));
  return close(ours.within_3_mrad, reference.within_3_mrad, 0.15 * fewer, step_s) &&
         close(ours.within_2_mrad, reference.within_2_mrad, 0.15 * fewer, step_s) &&
         close(ours.within_1_mrad, reference.within_1_mrad, 0.35 * fewer, step_s);
}

Result<std::map<std::string, std::string, std::less<>>> spreads_of(const campaign::Campaign& campaign,
                                                                   const campaign::Store& store) {
  constexpr std::size_t batches = 10;
  std::map<std::string, std::string, std::less<>> all;
  for (std::size_t v = 0; v < campaign.variants.size(); ++v) {
    const auto runs = store.load(v);
    if (!runs) return tl::unexpected(runs.error());
    const std::size_t size = runs->size() / batches;
    if (size == 0) return all;
    std::vector<Times> times;
    for (std::size_t b = 0; b < batches; ++b)
      times.push_back(times_of(
          campaign::rms_curve(std::span(*runs).subspan(b * size, size), quantities::attitude_heading)));
    std::string& words = all[campaign.variants[v].name];
    for (const auto entry : entries) {
      const auto [low, high] = std::ranges::minmax(times, {}, entry);
      words += words.empty() ? "" : " / ";
      words += time_words(low.*entry);
      if (low.*entry != high.*entry) words += "-" + time_words(high.*entry);
    }
  }
  return all;
}

}  // namespace canhil::papers::transfer_alignment
