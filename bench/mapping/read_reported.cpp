#include "bench/mapping/read_reported.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>

#include "bench/mapping/own_quantities.hpp"

namespace canhil::mapping {
namespace {

using scenario::Section;
using What = ReportedSignal::What;

constexpr std::array<std::string_view, 4> quaternion_parts{"attitude.quaternion.w", "attitude.quaternion.x",
                                                           "attitude.quaternion.y", "attitude.quaternion.z"};

class SignalReader {
 public:
  SignalReader(Section& signals, std::optional<Section>& invalid, const Known& known, Hear& hear)
      : signals_(signals), invalid_(invalid), known_(known), hear_(hear) {}

  void read() {
    for (const std::string& key : signals_.keys()) read(key);
    if (hear_.quaternion && !signals_.error()) add_angles();
    signals_.finish();
  }

 private:
  void read(const std::string& key) {
    const dbc::Signal* one = dbc::find_signal(*hear_.of.message, key);
    std::string word = signals_.text(key);
    if (one == nullptr) {
      std::vector<std::string_view> names;
      for (const dbc::Signal& signal : hear_.of.message->signals) names.push_back(signal.name);
      signals_.reject(key, fmt::format("{} has no signal '{}'", hear_.of.message->name, key),
                      fmt::format("one of: {}", fmt::join(names, ", ")));
    }
    if (one == nullptr || word.empty()) return;
    const double sign = word.starts_with('-') ? -1 : 1;
    if (sign < 0) word.erase(0, 1);
    const auto part = std::ranges::find(quaternion_parts, word);
    if (part != quaternion_parts.end())
      read_part(key, *one, static_cast<std::size_t>(part - quaternion_parts.begin()), sign);
    else
      read_quantity(key, *one, std::move(word), sign);
  }

  void read_part(const std::string& key, const dbc::Signal& signal, std::size_t part, double sign) {
    if (!hear_.quaternion) hear_.quaternion.emplace();
    if (hear_.quaternion->parts[part] != nullptr)
      signals_.reject(key, fmt::format("is {} too", quaternion_parts[part]), "each part once");
    hear_.quaternion->parts[part] = &signal;
    hear_.quaternion->factors[part] =
        sign * known_.units.factor(signals_, key, *hear_.of.message, signal, "", quaternion_parts[part]);
    if (const auto raw = invalid_raw(key, signal)) hear_.quaternion->invalid[part] = *raw;
  }

  // The angles of the quaternion are reported like those of signals of their own.
  void add_angles() {
    for (std::size_t i = 0; i < quaternion_parts.size(); ++i) {
      if (hear_.quaternion->parts[i] == nullptr)
        return signals_.reject(hear_.quaternion->parts[(i + 1) % 4] == nullptr
                                   ? hear_.of.message->name
                                   : hear_.quaternion->parts[(i + 1) % 4]->name,
                               fmt::format("is a part of a quaternion without {}", quaternion_parts[i]),
                               "all four parts in one message");
    }
    for (const auto& [name, angle] :
         {std::pair("attitude.roll", &world::Euler::roll), std::pair("attitude.pitch", &world::Euler::pitch),
          std::pair("attitude.heading", &world::Euler::heading)})
      hear_.reported_signals.push_back({.signal = hear_.quaternion->parts.front(),
                                        .quantity = find_reference_quantity(name),
                                        .angle = angle});
  }

  void read_quantity(const std::string& key, const dbc::Signal& signal, std::string word, double sign) {
    constexpr std::string_view sigma = ".sigma", correlation = "correlation(";
    ReportedSignal telling{.signal = &signal};
    if (word.ends_with(sigma)) {
      telling.what = What::sigma;
      word.erase(word.size() - sigma.size());
    }
    const std::size_t comma = word.find(", ");
    if (word.starts_with(correlation) && word.ends_with(')') && comma != std::string::npos) {
      telling.what = What::correlation;
      const std::size_t other = comma + 2;
      telling.other = quantity(key, word.substr(other, word.size() - 1 - other));
      word = word.substr(correlation.size(), comma - correlation.size());
    }
    telling.quantity = quantity(key, word, &signal);
    if (signals_.error()) return;
    std::string_view si = telling.what == What::correlation ? "" : telling.quantity->si;
    if (telling.what == What::sigma && is_on_the_ground(*telling.quantity) &&
        known_.units.si_of(signal) == "m") {
      telling.in_metres = true;
      si = "m";
    }
    telling.factor = sign * known_.units.factor(signals_, key, *hear_.of.message, signal, si, word);
    telling.invalid = invalid_raw(key, signal);
    hear_.reported_signals.push_back(telling);
  }

  // The quantity with this name that the target may report. Null: there is none, and the section has an
  // error.
  // `signal`: carries the value itself; null: it carries something about the quantity.
  const ReferenceQuantity* quantity(const std::string& key, std::string_view word,
                                    const dbc::Signal* signal = nullptr) {
    const ReferenceQuantity* built_in = find_reference_quantity(word);
    if (built_in != nullptr && built_in->of.empty()) return built_in;
    std::vector<std::string_view> names;
    for (const ReferenceQuantity& one : known_.own) {
      if (one.quantity->name == word) return &one;
      names.push_back(one.quantity->name);
    }
    if (signal != nullptr && word.ends_with(command_ending))
      return &add_command(known_.own, word, known_.units.si_of(*signal));
    for (const ReferenceQuantity& one : reference_quantities()) {
      if (one.of.empty()) names.push_back(one.quantity->name);
    }
    signals_.reject(
        key, fmt::format("'{}' is not a quantity that a target reports", word),
        fmt::format("one of: {}; or one with '.sigma'; or 'correlation(ONE, OTHER)'; or NAME.command; or "
                    "'attitude.quaternion.w' and its other parts; or one of [quantities]",
                    fmt::join(names, ", ")));
    return nullptr;
  }

  std::optional<std::uint64_t> invalid_raw(const std::string& key, const dbc::Signal& signal) {
    if (!invalid_ || !invalid_->has(key)) return std::nullopt;
    const auto raw = static_cast<std::uint64_t>(invalid_->integer(key, 0));
    expect_bits(*invalid_, key, signal, raw);
    return raw;
  }

  Section& signals_;
  std::optional<Section>& invalid_;
  const Known& known_;
  Hear& hear_;
};

}  // namespace

void read_reported(Section& signals, std::optional<Section>& invalid, const Known& known, Hear& hear) {
  SignalReader(signals, invalid, known, hear).read();
}

void expect_bits(Section& section, const std::string& key, const dbc::Signal& signal, std::uint64_t raw) {
  if (signal.length < 64 && raw >> signal.length != 0)
    section.reject(key, fmt::format("{} does not fit into its {} bits", raw, signal.length),
                   "the bits as a whole number without a sign");
}

}  // namespace canhil::mapping
