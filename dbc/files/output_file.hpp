// Output files of all programs: a file gets its name only when it is complete.
#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil {

/// A new file that has a temporary name until it is complete. The temporary name is random, and the file is
/// created only if nothing has this name, so the program never writes to a file or follows a link that
/// another user has put there.
class OutputFile {
 public:
  /// Creates an empty file in the folder of `path`. The error is one line with `path` and the reason.
  static Result<OutputFile> create(const std::string& path);
  /// Takes over the file; `other` no longer removes it.
  OutputFile(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile& operator=(OutputFile&&) = delete;
  /// Removes the file, unless it has been given its name.
  ~OutputFile();

  /// A buffered stream for writing, which the caller must close. May be called once. Null, with errno: no
  /// memory.
  [[nodiscard]] std::FILE* take_stream();
  /// The path of the file until it has its name.
  [[nodiscard]] const std::string& temporary_name() const { return temporary_name_; }
  /// Renames the file, and thereby replaces a file or a link of this name. Returns errno; 0: no error.
  [[nodiscard]] int give_name(const std::string& name);

 private:
  OutputFile(int descriptor, std::string temporary_name)
      : descriptor_(descriptor), temporary_name_(std::move(temporary_name)) {}

  int descriptor_;              // -1: taken
  std::string temporary_name_;  // empty: the file has its name
};

/// Receives the parts of a content in their order.
using Sink = std::function<void(std::string_view part)>;

/// Writes a file completely or not at all. After an error, which is one line of text, an existing file is
/// unchanged. `content` passes the parts of the content to the sink one by one, so a large content is never
/// in memory as a whole.
Result<void> write_file(const std::string& path, const std::function<void(const Sink&)>& content);
/// Like write_file(), but `content` may fail: then its error is returned, and an existing file is unchanged.
Result<void> write_file_unless_failed(const std::string& path,
                                      const std::function<Result<void>(const Sink&)>& content);
/// Writes a content that is in memory, completely or not at all.
Result<void> write_file(const std::string& path, std::string_view content);

/// Checks, before a long run, whether a file can be written: the folder of the file must be writable, and an
/// existing file must be a regular file. The error is one line of text.
Result<void> check_writable(const std::string& path);

/// Creates an empty file that is given its name at once, for a program part that must open a file by its
/// name. Error, one line: it cannot be created, or something has this name already (a link, too).
Result<void> create_new_file(const std::string& path);

}  // namespace canhil
