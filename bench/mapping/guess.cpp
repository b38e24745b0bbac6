#include "bench/mapping/guess.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <utility>

#include "bench/mapping/reference_quantities.hpp"
#include "bench/quantities/wire_unit.hpp"
#include "bench/sensors/measurands.hpp"

namespace canhil::mapping {
namespace {

using Words = std::set<std::string, std::less<>>;

struct Meaning {
  std::string_view word, quantities;  // words of the names of quantities, with spaces
};
// What the words of DBC files mean.
constexpr auto meanings = std::to_array<Meaning>({
    {"acc", "specific force"},
    {"accel", "specific force"},
    {"acceleration", "specific force"},
    {"force", "specific"},
    {"gyr", "rate"},
    {"gyro", "rate"},
    {"omega", "rate"},
    {"vel", "velocity"},
    {"speed", "velocity"},
    {"spd", "speed"},
    {"sog", "speed"},
    {"lat", "latitude"},
    {"lon", "longitude"},
    {"lng", "longitude"},
    {"long", "longitude"},
    {"alt", "height"},
    {"altitude", "height"},
    {"hgt", "height"},
    {"hdg", "heading"},
    {"yaw", "heading z"},
    {"azimuth", "heading"},
    {"cog", "course"},
    {"track", "course"},
    {"roll", "x"},
    {"pitch", "y"},
    {"n", "north"},
    {"e", "east"},
    {"d", "down"},
    {"mag", "magnetometer"},
    {"compass", "magnetometer"},
    {"cmp", "magnetometer"},
    {"whl", "wheels"},
    {"wheel", "wheels"},
    {"fl", "front left"},
    {"fr", "front right"},
    {"rl", "rear left"},
    {"rr", "rear right"},
    {"press", "pressure"},
    {"temp", "temperature"},
    {"dpt", "depth"},
    {"gnss", "gps"},
    {"pos", "position"},
    {"ele", "elevator"},
    {"rud", "rudder"},
});

// The words of a name, in lower case, with what they mean: "TX1_YawRate" has yaw, heading, z and rate.
Words words_of(std::string_view name) {
  Words words;
  std::string word;
  const auto end_word = [&] {
    if (word.size() > 3 && word.ends_with('s')) words.insert(word.substr(0, word.size() - 1));
    if (!word.empty()) words.insert(std::exchange(word, ""));
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    const bool after_lower = i > 0 && std::islower(static_cast<unsigned char>(name[i - 1])) != 0;
    if (std::isalpha(c) == 0 || (std::isupper(c) != 0 && after_lower)) end_word();
    if (std::isalpha(c) != 0) word += static_cast<char>(std::tolower(c));
  }
  end_word();
  Words all = words;
  for (const Meaning& one : meanings) {
    if (!words.contains(one.word)) continue;
    for (std::string_view rest = one.quantities; !rest.empty();) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      all.emplace(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
  return all;
}

bool has_any(const Words& words, std::initializer_list<std::string_view> of) {
  return std::ranges::any_of(of, [&](std::string_view one) { return words.contains(one); });
}

// How well a quantity fits; 0: it does not. Its last word must be in the name of the signal; the words before
// may be in the name of the message.
int fit(std::string_view quantity, const Words& of_signal, const Words& of_message) {
  const auto known = [&](std::string_view word) {
    return of_signal.contains(word) ? 2 : of_message.contains(word) ? 1 : 0;
  };
  const std::size_t dot = quantity.find('.');
  int score = 1;
  std::string_view last;
  for (std::size_t at = 0; at < quantity.size();) {
    const std::size_t end = std::min(quantity.find_first_of("._", at), quantity.size());
    last = quantity.substr(at, end - at);
    const bool is_sensor = at < dot && dot != std::string_view::npos;
    score += known(last) > 0 ? known(last) : is_sensor ? 0 : -1;
    at = end + 1;
  }
  return of_signal.contains(last) ? std::max(score, 0) : 0;
}

// The quantity that fits best; empty: none does. If several fit as well, it is the first.
template <class All, class Name>
std::string best(const All& all, const dbc::Message& message, const dbc::Signal& signal, Name name_of) {
  const Words of_signal = words_of(signal.name), of_message = words_of(message.name);
  if (is_counter(signal) || is_checksum(signal)) return "";
  std::string found;
  int most = 0;
  for (const auto& one : all) {
    const std::string_view name = name_of(one);
    const auto unit = quantities::wire_unit(signal.unit, one.si);
    if (name.empty() || !unit || unit->si != one.si) continue;
    if (const int score = fit(name, of_signal, of_message); score > most) {
      most = score;
      found = name;
    }
  }
  return found;
}

}  // namespace

bool is_counter(const dbc::Signal& signal) {
  return has_any(words_of(signal.name), {"counter", "count", "cnt", "alive", "seq", "sequence"});
}

bool is_checksum(const dbc::Signal& signal) {
  return has_any(words_of(signal.name), {"crc", "checksum", "chk", "cs"});
}

std::string guess_played(const dbc::Message& message, const dbc::Signal& signal) {
  return best(sensors::measurands(), message, signal,
              [](const sensors::Measurand& one) -> std::string_view { return one.name; });
}

std::string guess_reported(const dbc::Message& message, const dbc::Signal& signal) {
  std::string name = best(reference_quantities(), message, signal, [](const ReferenceQuantity& one) {
    return one.has_truth() && one.of.empty() ? std::string_view(one.quantity->name) : std::string_view();
  });
  if (!name.empty() && has_any(words_of(signal.name), {"sigma", "std", "stddev", "sd", "accuracy"}))
    name += ".sigma";
  return name;
}

}  // namespace canhil::mapping
