// The bytes of a log, whatever they are stored in: a file, a pipe or FIFO, memory. A file compressed with
// gzip is decompressed, and text in UTF-16 is converted to UTF-8; both are detected from the content. The
// input is read once, from the beginning to the end, with memory of a fixed size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::logs {

/// A stage of the input: a source of bytes, or a conversion of the bytes of another stage.
class Bytes {
 public:
  Bytes() = default;
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;
  virtual ~Bytes() = default;
  /// Reads at least one byte and at most as many as fit; 0: the end. Does not wait until `to` is full, so
  /// that a reader of a pipe receives what has been written so far. The error says what is wrong, not where.
  virtual Result<std::size_t> read(std::span<char> to) = 0;
};

/// Decompresses gzip data (RFC 1952), which may have several members.
std::unique_ptr<Bytes> gunzip(std::unique_ptr<Bytes> from);
/// Converts UTF-16 to UTF-8. Surrogates without their other half become U+FFFD.
std::unique_ptr<Bytes> utf8_of_utf16(std::unique_ptr<Bytes> from, bool big_endian);

/// A buffered input with a look-ahead.
class Input {
 public:
  /// The largest number of bytes that peek() can show.
  static constexpr std::size_t longest_peek = std::size_t{1} << 17U;

  /// Opens a file, a pipe or a FIFO. `name` is its name in messages. An error is one line.
  static Result<Input> open(const std::string& path, std::string name);
  /// An input whose bytes come from elsewhere. They are not converted.
  static Input of(std::unique_ptr<Bytes> bytes, std::string name) {
    return Input(std::move(bytes), std::move(name));
  }
  /// An input in memory, whose content must outlive it. It is converted as a file is.
  static Result<Input> of_memory(std::string_view content, std::string name);

  /// The next bytes, at most `most` of them and fewer only at the end. The view is valid until the next call.
  Result<std::string_view> peek(std::size_t most);
  /// The bytes that have been read and not yet been taken. If there are none, waits for some; empty: the end.
  Result<std::string_view> available();
  /// Marks bytes that peek() or available() has shown as read.
  void take(std::size_t bytes) { begin_ += bytes; }
  /// Reads exactly as many bytes as fit; false: the input ends before.
  Result<bool> read(std::span<char> to);
  /// Reads and discards bytes; false: the input ends before.
  Result<bool> skip(std::uint64_t bytes);

  /// The name of the log, for messages.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  Input(std::unique_ptr<Bytes> bytes, std::string name) : bytes_(std::move(bytes)), name_(std::move(name)) {}
  static constexpr std::size_t usual_size = std::size_t{1} << 15U;

  Result<std::size_t> fill();
  Result<void> convert();

  std::unique_ptr<Bytes> bytes_;
  std::string name_;
  std::vector<char> buffer_ = std::vector<char>(usual_size);  // grows if peek() asks for more
  std::size_t begin_ = 0, end_ = 0;
};

}  // namespace canhil::logs
