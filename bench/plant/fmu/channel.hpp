// The connection between the bench and the process of an FMU: records of binary values over a socket, in the
// byte order of the machine. The bench sends a Setup and then a step at a time; each is answered. An empty
// record ends the connection.
#pragma once

#include <chrono>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bench/plant/fmu/value.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::plant::fmu {

/// A record that grows.
class Writer {
 public:
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(T value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void add(std::string_view text) {
    add(text.size());
    bytes_ += text;
  }
  void add(std::span<const double> values) {
    for (const double value : values) add(value);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads a record from its begin. After a value that the record does not have, `wrong` is true and all values
/// are empty.
class RecordReader {
 public:
  explicit RecordReader(std::string_view bytes) : left_(bytes) {}
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> T take() {
    T value{};
    const std::string_view bytes = take_bytes(sizeof value);
    if (!bytes.empty()) std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  std::string take_text() { return std::string(take_bytes(take<std::size_t>())); }
  void take(std::span<double> values) {
    for (double& value : values) value = take<double>();
  }
  [[nodiscard]] bool wrong() const { return wrong_; }
  [[nodiscard]] std::size_t left() const { return left_.size(); }

 private:
  std::string_view take_bytes(std::size_t count) {
    wrong_ = wrong_ || count > left_.size();
    if (wrong_) return {};
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
  }
  std::string_view left_;
  bool wrong_ = false;
};

void write_setup(Writer& writer, const Setup& setup);
Setup read_setup(RecordReader& reader);

/// One end of the connection; the destructor closes it.
class Channel {
 public:
  explicit Channel(int descriptor) : descriptor_(descriptor) {}
  Channel(Channel&& other) noexcept;
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  ~Channel() { close(); }

  using Clock = std::chrono::steady_clock;
  enum class Outcome : std::uint8_t { done, closed, late };
  Outcome send(const std::string& record, std::optional<Clock::time_point> deadline = {}) const;
  Outcome receive(std::string& record, std::optional<Clock::time_point> deadline = {}) const;
  void close();

 private:
  [[nodiscard]] Outcome wait(short events, std::optional<Clock::time_point> deadline) const;
  Outcome receive_bytes(char* to, std::size_t count, std::optional<Clock::time_point> deadline) const;

  int descriptor_;
};

}  // namespace canhil::plant::fmu
