// What a matrix of faults came to: a file of JSON lines, the first of which says of what it is, each other a
// finished cell. A run that was interrupted goes on with its file; files of shards are put together.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bench/fault_matrix/plan.hpp"
#include "bench/fault_matrix/response.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::fault_matrix {

/// What results must have in common to be put together, as one line of JSON.
struct Identity {
  std::string line;
  std::uint64_t seed = 0, runs = 1;
  std::string target;  ///< empty: the target's own code, in process
  struct Column {
    std::string file, title, estimators;
  };
  std::vector<Column> columns{};
  std::vector<Row> rows{};
  std::size_t cells = 0;  ///< of all shards
};
Identity identity_of(const Plan& plan, const std::string& target);

struct Finished {
  std::size_t cell = 0;  ///< its place in Plan::cells
  std::size_t row = 0, column = 0;
  std::uint64_t run = 0;
  std::vector<std::string> faults{};  ///< each in one line
  Response response{};
  std::string replay{};              ///< of a violation: the least scenario that shows it
  std::vector<std::string> least{};  ///< its faults
};

struct Results {
  Identity identity;
  std::map<std::size_t, Finished> cells{};  ///< by Finished::cell
};

/// Of one file. Error: one line; not readable, or no such results. A last line that was cut off is left out.
Result<Results> read_results(const std::filesystem::path& file);

/// All of these files. Error: one line; of different matrices, or cells that are in no file.
Result<Results> merged(std::span<const std::filesystem::path> files);

/// A file that grows by cells.
class Writer {
 public:
  /// A new file; with `resume`, one that is there too, whose cells are given. Error: one line; it is there,
  /// or of another matrix, or cannot be written.
  static Result<std::pair<Writer, Results>> open(const std::filesystem::path& file, const Identity& identity,
                                                 bool resume);
  /// Error: one line.
  Result<void> add(const Finished& finished);

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace canhil::fault_matrix
