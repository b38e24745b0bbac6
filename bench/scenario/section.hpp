// A table of a scenario file, read strictly: the reader must request every key in the table, with the type
// and limits of the key.
//
// The first error of the file is kept, and those after it that cannot be consequences of another: values of
// the wrong type or out of range and the first unknown key of each table, up to the first missing key,
// unknown word or error of another kind. Readers need not check for errors: after an error they receive
// harmless values. A key's unit is its suffix (heading_deg); values are returned in SI and radians.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/scenario/described.hpp"
#include "bench/scenario/quantity.hpp"
#include "bench/scenario/setting.hpp"
#include "bench/world/attitude.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::scenario {

class Section {
 public:
  /// Parses a whole file. `settings` replace values of the file before any key is read. A text that is not
  /// TOML is the file's first error. Errors about a setting have no line.
  static Section parse(std::string_view text, std::string_view file_name,
                       std::span<const Setting> settings = {});

  /// The text of a file with the values of `settings`, as a file that may be in any folder: the paths of the
  /// files that it names, relative to `folder`, become absolute. A setting without a value removes its key.
  /// The text and the settings must be those of a scenario that was read. Comments are lost.
  static std::string edited_text(std::string_view text, std::span<const Setting> settings,
                                 const std::string& folder);

  /// Sets the folder of the files that this file names.
  void look_in(std::string folder);

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] int line() const;
  /// The key, preceded by the path of its tables.
  [[nodiscard]] std::string path(std::string_view key) const;

  /// The place of a key: "file:line", or "file" if a setting added the key.
  [[nodiscard]] std::string where(std::string_view key) const;

  /// Accepts a key and ignores its value.
  void optional(std::string_view key);

  // Each of the following functions requests a key. Unless stated otherwise, a missing key is an error if
  // there is no fallback. The fallback is in the key's unit.

  /// A number in SI.
  double number(const Key& key, Limits limits, std::optional<double> fallback = {});
  /// A number in the unit of its key.
  double plain_number(const Key& key, Limits limits, std::optional<double> fallback = {});
  /// Three numbers in SI, from one number for all axes or from an array of three numbers; zeros if the key is
  /// absent.
  world::Vector3 three(const Key& key, Limits limits = {});
  /// Lower and upper end of an interval, in SI.
  std::pair<double, double> interval(const Key& key, Limits limits);
  std::int64_t integer(const Key& key, std::int64_t least);
  std::optional<std::int64_t> optional_integer(const Key& key, std::int64_t least);
  /// true or false; absent: false.
  bool flag(const Key& key);
  /// A time (key ending in _s or _ms): a whole number of microseconds.
  std::int64_t time_us(const Key& key, Limits limits, std::optional<double> fallback = {});
  std::optional<double> optional_number(const Key& key, Limits limits);
  std::optional<std::int64_t> optional_time_us(const Key& key, Limits limits);
  std::optional<std::pair<std::int64_t, std::int64_t>> optional_interval_us(const Key& key, Limits limits);
  /// Text on one line, not empty.
  std::string text(const Key& key, const std::optional<std::string>& fallback = {});
  std::string one_of(const Key& key, std::span<const std::string> names,
                     const std::optional<std::string>& fallback = {});
  /// Like one_of(), but for names that the user's files define, so the reference does not list these names.
  std::string given_name(const Key& key, std::span<const std::string> names,
                         const std::optional<std::string>& fallback = {});

  /// A path that the file contains, resolved against the folder of the file.
  [[nodiscard]] std::string beside(std::string_view path) const;
  /// The content of the file that a key names; none: it cannot be read, and the error is reported.
  std::optional<std::string> read_beside(const Key& key, std::string_view kind, std::size_t most_bytes);
  /// FNV-1a hash of all files that read_beside() has read; 0: no file has been read.
  [[nodiscard]] std::uint64_t& files_hash();
  /// The paths of the files that read_beside() has read, in the order in which they were read.
  [[nodiscard]] std::vector<std::string>& files();

  /// An array of some of these names; absent: empty.
  std::vector<std::string> some_of(const Key& key, std::span<const std::string> names);
  /// Arrays; absent: empty.
  std::vector<std::string> texts(const Key& key);
  std::vector<std::int64_t> integers(const Key& key, std::int64_t least);
  /// The keys of the table, in the order of their lines in the file.
  [[nodiscard]] std::vector<std::string> keys() const;
  [[nodiscard]] bool holds_text(std::string_view key) const;
  [[nodiscard]] bool holds_table(std::string_view key) const;
  /// Returns all values of this table, whatever their keys are. The caller uses them as settings for another
  /// file. Nested tables become keys with dots.
  std::vector<Setting> settings();

  /// A table. If the table is missing, finish() of the outer table reports this, and the returned table has
  /// no keys; its own finish() reports nothing.
  Section table(const Key& key);
  std::optional<Section> optional_table(const Key& key);
  /// An array of tables, at least one. Their paths are numbered from 1: check[1].
  std::vector<Section> tables(std::string_view key);

  /// A table, or an array of tables.
  std::vector<Section> table_or_tables(std::string_view key);

  /// Reports an error about a key, whether the key is present or missing.
  void reject(std::string_view key, std::string_view what, std::string_view expected);
  /// Reports an error (one line) in the file or text that a key names.
  void reject(std::string_view key, const Error& error);
  /// Makes finish() report that a key, or one of several keys, is missing; if the table also has an unknown
  /// key, finish() reports the unknown key instead.
  void missing(std::string_view key, std::string_view expected);
  /// Rejects a key if it is present. This is for a key that has no effect because of other keys in the file.
  void refuse(std::string_view key, std::string_view what, std::string_view expected);
  /// Must be called after all keys have been requested. Reports a key that is in the table but was not
  /// requested, with the given reason; if there is no such key, reports a missing key.
  void finish(std::string_view unasked = "is unknown");

  /// The errors of the whole file.
  [[nodiscard]] std::optional<Error> error() const;

 private:
  struct State;
  struct File;
  std::optional<std::int64_t> whole_number(const Key& key, std::int64_t least, bool required);
  /// Reads one of `names`. The reference of all keys shows `type` as the type of the value, and lists
  /// `words`.
  std::string choice(const Key& key, std::span<const std::string> names,
                     const std::optional<std::string>& fallback, std::string_view type,
                     std::vector<std::string> words);
  /// For a key that is requested only if it is present: records the key for the reference of all keys.
  void describe_optional(const Key& key, std::string_view type, const Limits& limits);
  explicit Section(std::shared_ptr<State> state) : state_(std::move(state)) {}

  std::shared_ptr<State> state_;
};

}  // namespace canhil::scenario
