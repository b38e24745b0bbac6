// The results of a fault matrix: a file of JSON lines. The first line identifies the matrix; each of the
// other lines is a finished cell. An interrupted run can be resumed with its file; the files of shards can be
// merged.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/fault_matrix/plan.hpp"
#include "bench/fault_matrix/response.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::fault_matrix {

/// The identity of a matrix, as one line of JSON. Results can be merged only if their identities are equal.
struct Identity {
  std::string line;
  std::uint64_t seed = 0, runs = 1;
  std::string target;  ///< command of the target; empty: the target code runs in the bench's process
  struct Column {
    std::string file, title, estimators;
  };
  std::vector<Column> columns{};
  std::vector<Row> rows{};
  std::size_t cells = 0;  ///< number of cells in all shards
};
Identity identity_of(const Plan& plan, const std::string& target);

struct Finished {
  std::size_t cell = 0;  ///< index in Plan::cells
  std::size_t row = 0, column = 0;
  std::uint64_t run = 0;
  std::vector<std::string> faults{};  ///< one line for each fault
  Response response{};
  std::string replay{};              ///< for a violation: file of the minimal scenario that shows it
  std::vector<std::string> least{};  ///< the faults of the minimal scenario
};

struct Results {
  Identity identity;
  std::map<std::size_t, Finished> cells{};  ///< by Finished::cell
};

/// Reads one file. Returns an Error of one line if the file is not readable or contains other data, or if a
/// line was changed since it was written. A truncated last line is ignored.
Result<Results> read_results(const std::filesystem::path& file);

/// Merges files. Returns an Error of one line if the files belong to different matrices or if cells are
/// missing.
Result<Results> merged(std::span<const std::filesystem::path> files);

/// A file to which finished cells are appended.
class Writer {
 public:
  /// Creates a file. With `resume`, it also opens an existing file and returns the cells of this file.
  /// Returns an Error of one line if the file exists (without `resume`), belongs to another matrix, or cannot
  /// be written.
  static Result<std::pair<Writer, Results>> open(const std::filesystem::path& file, const Identity& identity,
                                                 bool resume);
  /// Appends a cell to the file. An Error has one line.
  Result<void> add(const Finished& finished);

 private:
  struct CloseStream {
    void operator()(std::FILE* stream) const { (void)std::fclose(stream); }
  };
  Writer(std::filesystem::path path, Identity identity, std::FILE* stream)
      : path_(std::move(path)), identity_(std::move(identity)), stream_(stream) {}
  bool put(std::string line);

  std::filesystem::path path_;
  Identity identity_;
  std::unique_ptr<std::FILE, CloseStream> stream_;
};

}  // namespace canhil::fault_matrix
