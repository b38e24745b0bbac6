// Records which keys the readers request. The reference of keys (bench/reference) is generated from this
// record, so each range and default is written only once, in its reader.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/quantity.hpp"

namespace canhil::scenario {

/// The name of a key, and its meaning in one sentence.
struct Key {
  // NOLINTBEGIN(google-explicit-constructor): most keys are requested by name alone
  Key(const char* its_name) : name(its_name) {}
  Key(const std::string& its_name) : name(its_name) {}
  Key(std::string_view its_name) : name(its_name) {}
  // NOLINTEND(google-explicit-constructor)
  Key(std::string_view its_name, std::string_view its_meaning, std::string_view as_shown = {})
      : name(its_name), meaning(its_meaning), shown(as_shown) {}

  std::string_view name;
  std::string_view meaning;
  std::string_view shown;  ///< the name in the reference, if it depends on another key's value
};

/// A key as a reader requested it.
struct DescribedKey {
  std::string table{};  ///< path of the table that contains it; empty: the file itself
  std::string name{};
  std::string shown{};  ///< the name in the reference
  std::string meaning{};
  std::string type{};  ///< "number", "text", "table" ...
  Limits limits{};     ///< of a number, in the key's unit
  std::string fallback{};
  bool required = false;
  std::vector<std::string> words{};  ///< the permitted words
  std::string sample{};              ///< a permitted value, as TOML
};

struct Description {
  std::vector<DescribedKey> keys;
  std::set<std::string> looked_for;  ///< paths of keys whose presence affects the reader
};

/// While this object exists, it records every key that is requested from a section that the same thread
/// created.
class Describing {
 public:
  explicit Describing(Description& description);
  ~Describing();
  Describing(const Describing&) = delete;
  Describing& operator=(const Describing&) = delete;

  /// Null: nothing is recorded.
  static Description* current();

 private:
  Description* before_;
};

inline constexpr std::string_view interval_type = "[low, high]";

/// A number, or numbers, within limits.
DescribedKey described_number(std::string_view type, const Limits& limits, std::optional<double> fallback);

}  // namespace canhil::scenario
