#include "bench/plant/fmu/channel.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace canhil::plant::fmu {
namespace {

constexpr std::uint64_t longest_record = std::uint64_t{1} << 28U;

void write(Writer& writer, const Place& place) {
  writer.add(place.name);
  writer.add(place.reference);
  writer.add(place.type);
  writer.add(place.count);
}

void write(Writer& writer, const Preset& preset) {
  write(writer, preset.place);
  writer.add(preset.values.size());
  for (const Value& value : preset.values) {
    writer.add(value.index());
    std::visit([&writer](const auto& of_a_type) { writer.add(of_a_type); }, value);
  }
}

template <class T>
void write(Writer& writer, const std::vector<T>& all) {
  writer.add(all.size());
  for (const T& one : all) write(writer, one);
}

Place read_place(RecordReader& reader) {
  Place place{.name = reader.take_text()};
  place.reference = reader.take<std::uint32_t>();
  place.type = reader.take<Type>();
  place.count = reader.take<std::uint32_t>();
  return place;
}

Value read_preset_value(RecordReader& reader) {
  switch (reader.take<std::size_t>()) {
    case 0:
      return reader.take<double>();
    case 1:
      return reader.take<std::int64_t>();
    default:
      return reader.take_text();
  }
}

template <class Read>
auto read_all(RecordReader& reader, const Read& read) {
  std::vector<decltype(read(reader))> all;
  for (auto left = reader.take<std::size_t>(); left > 0 && !reader.wrong(); --left)
    all.push_back(read(reader));
  return all;
}

Preset read_preset(RecordReader& reader) {
  Preset preset{.place = read_place(reader)};
  preset.values = read_all(reader, read_preset_value);
  return preset;
}

}  // namespace

void write_setup(Writer& writer, const Setup& setup) {
  writer.add(setup.fmu);
  writer.add(setup.version);
  writer.add(setup.folder);
  writer.add(setup.library);
  writer.add(setup.token);
  writer.add(setup.log);
  writer.add(setup.tolerance);
  write(writer, setup.structure);
  write(writer, setup.parameters);
  write(writer, setup.inputs);
  write(writer, setup.outputs);
  writer.add(setup.starts.size());
  writer.add(std::span<const double>(setup.starts));
}

Setup read_setup(RecordReader& reader) {
  Setup setup{.fmu = reader.take_text()};
  setup.version = reader.take<std::int32_t>();
  setup.folder = reader.take_text();
  setup.library = reader.take_text();
  setup.token = reader.take_text();
  setup.log = reader.take<bool>();
  setup.tolerance = reader.take<double>();
  setup.structure = read_all(reader, read_preset);
  setup.parameters = read_all(reader, read_preset);
  setup.inputs = read_all(reader, read_place);
  setup.outputs = read_all(reader, read_place);
  setup.starts = read_all(reader, [](RecordReader& from) { return from.take<double>(); });
  return setup;
}

Channel::Channel(Channel&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

void Channel::close() {
  if (const int old = std::exchange(descriptor_, -1); old >= 0) ::close(old);
}

Channel::Outcome Channel::wait(short events, std::optional<Clock::time_point> deadline) const {
  pollfd watched{.fd = descriptor_, .events = events, .revents = 0};
  while (true) {
    int left_ms = -1;
    if (deadline) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(*deadline - Clock::now());
      if (left.count() <= 0) return Outcome::late;
      left_ms = static_cast<int>(std::min<std::int64_t>(left.count(), 1'000'000));
    }
    const int ready = ::poll(&watched, 1, left_ms);
    if (ready > 0) return Outcome::done;
    if (ready < 0 && errno != EINTR) return Outcome::closed;
  }
}

Channel::Outcome Channel::send(const std::string& record, std::optional<Clock::time_point> deadline) const {
  const auto size = static_cast<std::uint64_t>(record.size());
  std::string bytes(reinterpret_cast<const char*>(&size), sizeof size);
  bytes += record;
  for (std::string_view left = bytes; !left.empty();) {
    const ssize_t sent = ::send(descriptor_, left.data(), left.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      left.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (const Outcome outcome = wait(POLLOUT, deadline); outcome != Outcome::done) return outcome;
    } else if (errno != EINTR) {
      return Outcome::closed;
    }
  }
  return Outcome::done;
}

Channel::Outcome Channel::receive_bytes(char* to, std::size_t count,
                                        std::optional<Clock::time_point> deadline) const {
  while (count > 0) {
    if (const Outcome outcome = wait(POLLIN, deadline); outcome != Outcome::done) return outcome;
    const ssize_t got = ::recv(descriptor_, to, count, MSG_DONTWAIT);
    if (got > 0) {
      to += got;
      count -= static_cast<std::size_t>(got);
    } else if (got == 0 || (errno != EINTR && errno != EAGAIN && errno != EWOULDBLOCK)) {
      return Outcome::closed;
    }
  }
  return Outcome::done;
}

Channel::Outcome Channel::receive(std::string& record, std::optional<Clock::time_point> deadline) const {
  std::uint64_t size = 0;
  if (const Outcome outcome = receive_bytes(reinterpret_cast<char*>(&size), sizeof size, deadline);
      outcome != Outcome::done)
    return outcome;
  if (size > longest_record) return Outcome::closed;
  record.resize(size);
  return receive_bytes(record.data(), record.size(), deadline);
}

}  // namespace canhil::plant::fmu
