// The files of one command: no output may be an input, and each output needs a file of its own.
#pragma once

#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil {

/// The inputs and outputs that a command declares before it opens an output. Two paths are the same file if
/// their device and inode are equal, so other spellings and links count; for a file that does not exist yet,
/// its folder and its name are compared. The program's own file is always an input. Empty paths are ignored.
class CommandFiles {
 public:
  /// A path, and the option or the role by which messages name it, such as "--json" or "mapping".
  struct File {
    std::string role, path;
  };

  CommandFiles();
  /// An input, or several inputs.
  void reads(std::string role, std::string path);
  /// See reads() of one input.
  void reads(const std::vector<File>& files);
  /// An output; "-" is standard output, which can hold one output.
  void writes(std::string role, std::string path);
  /// An output that standard output cannot hold.
  void writes_file(std::string role, std::string path);
  /// A file that is written only in some cases. check_writable() does not check it.
  void may_write(std::string role, std::string path);

  /// Error, one line with both files: an output is an input, or two outputs are the same file.
  [[nodiscard]] Result<void> check_distinct() const;
  /// Error, one line: an output cannot be written (see canhil::check_writable).
  [[nodiscard]] Result<void> check_writable() const;
  /// check_distinct(), then check_writable().
  [[nodiscard]] Result<void> check() const;

 private:
  struct Output {
    File file;
    bool to_stdout = false;  // the path is "-" and standard output can hold the output
    bool certain = true;
  };
  std::vector<File> inputs_;
  std::vector<Output> outputs_;
};

/// Checks that all paths are different files. The error is one line with the path that is given twice.
Result<void> check_distinct_inputs(const std::vector<std::string>& paths);

}  // namespace canhil
