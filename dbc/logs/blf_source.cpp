#include <fmt/format.h>

#include <array>
#include <map>
#include <vector>

#include "dbc/logs/blf.hpp"
#include "dbc/logs/little_endian.hpp"
#include "dbc/logs/local_time.hpp"
#include "dbc/logs/words.hpp"

namespace canhil::logs {
namespace {

constexpr std::size_t offset_flags = 16, offset_time = 24;
constexpr std::uint32_t unit_10_us = 1;
constexpr std::int64_t ns_per_10_us = 10'000;
constexpr std::uint64_t longest_since_start_ns = 1'000'000'000ULL * ns_per_s;
// The largest object that is read as a whole. Frames have less than 200 bytes; larger objects (texts, images)
// are skipped.
constexpr std::uint32_t largest_object = 1 << 16;

bool is_read_object(std::uint32_t type) {
  using enum blf::Type;
  return type == can_message || type == can_message_2 || type == can_error || type == can_error_ext ||
         type == can_fd_message || type == can_fd_message_64 || type == can_fd_error_64 || type == app_text;
}

// The start of the log, a SYSTEMTIME. Zeros: it is not stated; the times count from 1970.
std::optional<std::int64_t> time_of_system_time(std::span<const std::uint8_t> system_time) {
  std::array<int, 8> field{};
  for (std::size_t i = 0; i < field.size(); ++i)
    field.at(i) = little_endian<std::uint16_t>(system_time, 2 * i);
  const auto [year, month, day_of_week, day, hour, minute, second, ms] = field;
  if (year == 0) return 0;
  if (year < 1970 || year > 2200 || month < 1 || month > 12 || day > 31 || hour > 23 || minute > 59 ||
      second > 60 || ms > 999)
    return std::nullopt;
  std::tm when{};
  when.tm_year = year - 1900;
  when.tm_mon = month - 1;
  when.tm_mday = day;
  when.tm_hour = hour;
  when.tm_min = minute;
  when.tm_sec = second;
  constexpr std::int64_t one_ms_ns = 1'000'000;
  return since_1970_s(when) * ns_per_s + ms * one_ms_ns;
}

class BlfSource final : public LogSource {
 public:
  BlfSource(Input input, std::int64_t start_ns)
      : name_(input.name()),
        objects_(Input::of(blf::contents_of_containers(std::move(input)), name_)),
        start_ns_(start_ns) {}

  Result<std::optional<LogEntry>> next() override {
    for (;;) {
      const auto header = blf::next_header(objects_);
      ++number_;
      if (!header) return at_object(header.error());
      if (!*header) return std::optional<LogEntry>();
      type_ = (*header)->type;
      const std::uint32_t size = (*header)->object_size;
      if (!is_read_object(type_) || size > largest_object) {
        leave_out(type_ == 4 ? "bus statistics" : "objects other than frames of CAN");
        const auto skipped = objects_.skip(size);
        if (!skipped) return tl::unexpected(skipped.error());
        if (!*skipped) return at_object({"its last object is cut"});
        continue;
      }
      object_.resize(size);
      const auto got = objects_.read({reinterpret_cast<char*>(object_.data()), object_.size()});
      if (!got) return tl::unexpected(got.error());
      if (!*got) return at_object({"its last object is cut"});
      auto parsed = parse(**header);
      if (!parsed) {  // the next object begins where the header says, so only this one is lost
        leave_out("objects that are not valid, expected " + parsed.error().message);
        continue;
      }
      if (parsed->entry) return std::move(parsed->entry);
      if (!parsed->left_out.empty()) leave_out(parsed->left_out);
    }
  }
  [[nodiscard]] std::string last() const override {
    return fmt::format("{}: object {} of type {}", name_, number_, type_);
  }

 private:
  [[nodiscard]] Result<std::optional<LogEntry>> at_object(const Error& error) const {
    return failure(fmt::format("{}: object {}: {}", name_, number_, error.message));
  }

  Result<Parsed> parse(const blf::Header& header) {
    if (header.size < blf::header_size) return failure("a header of 32 bytes, or more");
    const std::span<const std::uint8_t> object(object_);
    const auto body = object.subspan(header.size);
    if (header.type == blf::app_text) {
      read_text(body);
      return Parsed{};
    }
    unsigned channel = 0;
    auto parsed = blf::frame_of_object(header.type, body, channel);
    if (!parsed || !parsed->entry) return parsed;
    const auto time = little_endian<std::uint64_t>(object, offset_time);
    const bool coarse = little_endian<std::uint32_t>(object, offset_flags) == unit_10_us;
    if (time > longest_since_start_ns / (coarse ? ns_per_10_us : 1))
      return failure("a time of at most 1e9 s");
    parsed->entry->t_ns = start_ns_ + static_cast<std::int64_t>(time) * (coarse ? ns_per_10_us : 1);
    parsed->entry->interface = interface_of(channel);
    return parsed;
  }

  // APP_TEXT: source u32, details u32, length u32, 4 bytes, text. The details of a channel have its number in
  // the second byte, and the type of its bus in the third.
  void read_text(std::span<const std::uint8_t> body) {
    constexpr std::size_t offset_text = 16;
    if (body.size() < offset_text || little_endian<std::uint32_t>(body, 0) != blf::channel_text) return;
    const auto details = little_endian<std::uint32_t>(body, 4);
    const auto length = little_endian<std::uint32_t>(body, 8);
    if ((details >> 16U & 0xFFU) != blf::bus_type_can || length > body.size() - offset_text) return;
    std::string_view text(reinterpret_cast<const char*>(body.data()) + offset_text, length);
    text = text.substr(0, text.find('\0'));
    const std::size_t semicolon = text.find(';');
    if (semicolon != std::string_view::npos && semicolon + 1 < text.size())
      names_[details >> 8U & 0xFFU] = interface_name(text.substr(semicolon + 1));
  }

  const std::string& interface_of(unsigned channel) {
    const auto named = names_.find(channel);
    if (named != names_.end()) return named->second;
    return names_.emplace(channel, fmt::format("can{}", channel == 0 ? 0 : channel - 1)).first->second;
  }

  std::string name_;
  Input objects_;
  std::int64_t start_ns_;
  std::vector<std::uint8_t> object_;
  std::size_t number_ = 0;
  std::uint32_t type_ = 0;
  std::map<unsigned, std::string> names_;
};

}  // namespace

Result<std::unique_ptr<LogSource>> blf_source(Input input) {
  std::array<std::uint8_t, blf::file_header_used> head{};
  const auto got = input.read({reinterpret_cast<char*>(head.data()), head.size()});
  if (!got) return tl::unexpected(got.error());
  const std::uint32_t size = little_endian<std::uint32_t>(head, 4);
  const auto start_ns =
      time_of_system_time(std::span<const std::uint8_t>(head).subspan(blf::offset_start, 16));
  const auto rest = *got && size >= head.size() ? input.skip(size - head.size()) : Result<bool>(false);
  if (!rest) return tl::unexpected(rest.error());
  if (!*rest || !start_ns)
    return failure(
        fmt::format("cannot read log '{}': its header is wrong, expected that of a BLF file with its "
                    "size and start time",
                    input.name()));
  return std::make_unique<BlfSource>(std::move(input), *start_ns);
}

}  // namespace canhil::logs
