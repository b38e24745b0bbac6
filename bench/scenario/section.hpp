// One table of a scenario file, read strictly: every key that is in it must be asked for, with its type and
// limits.
//
// The first error of the file is kept, and readers need not look at it: after it, they get harmless values. A
// key's unit is the end of its name (heading_deg); values come back in SI and radians.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/scenario/quantity.hpp"
#include "bench/scenario/setting.hpp"
#include "bench/world/attitude.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::scenario {

class Section {
 public:
  /// The file as a whole, with settings put into it before it is read. A text that is not TOML is the file's
  /// first error. Errors about a setting have no line.
  static Section parse(std::string_view text, std::string_view file_name,
                       std::span<const Setting> settings = {});

  /// Files that it names are looked for in another folder than its own.
  void look_in(std::string folder);

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] int line() const;
  /// The key with the path of the tables around it.
  [[nodiscard]] std::string path(std::string_view key) const;

  /// "file:line" of a key, or "file" if a setting put it there.
  [[nodiscard]] std::string where(std::string_view key) const;

  /// Says that a key may be there, though nothing more of it is wanted.
  void optional(std::string_view key);

  // Each of these asks for a key. Without a fallback (in the key's unit) a missing key is an error.

  /// A number in SI.
  double number(std::string_view key, Limits limits, std::optional<double> fallback = {});
  /// A number in the unit of its key.
  double plain_number(std::string_view key, Limits limits, std::optional<double> fallback = {});
  /// One number for three axes, or an array of three, in SI; 0 if absent.
  world::Vector3 three(std::string_view key, Limits limits = {});
  /// Lower and upper end of an interval, in SI.
  std::pair<double, double> interval(std::string_view key, Limits limits);
  std::int64_t integer(std::string_view key, std::int64_t least);
  std::optional<std::int64_t> optional_integer(std::string_view key, std::int64_t least);
  /// true or false; absent: false.
  bool flag(std::string_view key);
  /// A time (key ending in _s or _ms): a whole number of microseconds.
  std::int64_t time_us(std::string_view key, Limits limits, std::optional<double> fallback = {});
  std::optional<std::int64_t> optional_time_us(std::string_view key, Limits limits);
  std::optional<std::pair<std::int64_t, std::int64_t>> optional_interval_us(std::string_view key,
                                                                            Limits limits);
  /// Text on one line, not empty.
  std::string text(std::string_view key, const std::optional<std::string>& fallback = {});
  std::string one_of(std::string_view key, std::span<const std::string> names,
                     const std::optional<std::string>& fallback = {});

  /// A path that the file names, as seen from the file's folder.
  [[nodiscard]] std::string beside(std::string_view path) const;
  /// The content of the file that a key names; none: it cannot be read, and that has been said.
  std::optional<std::string> read_beside(std::string_view key, std::string_view kind, std::size_t most_bytes);
  /// FNV-1a of all that was read so; 0: nothing was.
  [[nodiscard]] std::uint64_t& files_hash();
  /// Their paths, in the order in which they were read.
  [[nodiscard]] std::vector<std::string>& files();

  /// An array of some of these names; absent: none.
  std::vector<std::string> some_of(std::string_view key, std::span<const std::string> names);
  /// Arrays; absent: empty.
  std::vector<std::string> texts(std::string_view key);
  std::vector<std::int64_t> integers(std::string_view key, std::int64_t least);
  /// The keys that are there, in their order.
  [[nodiscard]] std::vector<std::string> keys() const;
  [[nodiscard]] bool holds_text(std::string_view key) const;
  /// Everything in this table, whatever its keys: those of another file. Tables in it are keys with dots.
  std::vector<Setting> settings();

  /// A table; if it is missing, one whose keys are all silently absent.
  Section table(std::string_view key);
  std::optional<Section> optional_table(std::string_view key);
  /// An array of tables, at least one; its paths count from 1: check[1].
  std::vector<Section> tables(std::string_view key);

  /// A table, or an array of tables.
  std::vector<Section> table_or_tables(std::string_view key);

  /// Says what is wrong with the value of a key that is there, or should be.
  void reject(std::string_view key, std::string_view what, std::string_view expected);
  /// The same of what the key names: what is wrong there stands in one line.
  void reject(std::string_view key, const Error& error);
  /// Says that a key, or one of several, is missing; a key that nobody asked for is told before.
  void missing(std::string_view key, std::string_view expected);
  /// Rejects a key that is there though it has no effect beside the others.
  void refuse(std::string_view key, std::string_view what, std::string_view expected);
  /// To be called when all keys have been asked for: reports one that nobody asked for, as what it is, or
  /// else a missing one.
  void finish(std::string_view unasked = "is unknown");

  /// The first error of the whole file.
  [[nodiscard]] std::optional<Error> error() const;

 private:
  struct State;
  struct File;
  explicit Section(std::shared_ptr<State> state) : state_(std::move(state)) {}

  std::shared_ptr<State> state_;
};

}  // namespace canhil::scenario
