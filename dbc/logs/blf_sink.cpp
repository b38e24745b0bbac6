#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "dbc/logs/blf.hpp"
#include "dbc/logs/little_endian.hpp"
#include "dbc/logs/local_time.hpp"
#include "dbc/logs/words.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::logs {
namespace {

constexpr std::size_t container_size = 1 << 17;  // content of a container, as that of other programs
constexpr std::int64_t ns_per_ms = 1'000'000;

void append_system_time(std::string& bytes, std::int64_t t_ns) {
  const std::tm when = local_time(t_ns / ns_per_s);
  for (const std::int64_t field :
       {std::int64_t{when.tm_year + 1900}, std::int64_t{when.tm_mon + 1}, std::int64_t{when.tm_wday},
        std::int64_t{when.tm_mday}, std::int64_t{when.tm_hour}, std::int64_t{when.tm_min},
        std::int64_t{when.tm_sec}, t_ns % ns_per_s / ns_per_ms})
    append(bytes, static_cast<std::uint16_t>(field));
}

void append_base_header(std::string& bytes, std::size_t header_size, std::size_t object_size,
                        blf::Type type) {
  bytes += "LOBJ";
  append(bytes, static_cast<std::uint16_t>(header_size));
  append(bytes, std::uint16_t{1});  // header version
  append(bytes, static_cast<std::uint32_t>(object_size));
  append(bytes, static_cast<std::uint32_t>(type));
}

// The body of the object of a frame. The layouts are in blf_objects.cpp.
blf::Type append_body(std::string& bytes, const LogEntry& entry, std::uint16_t channel) {
  const Frame& frame = entry.frame;
  const std::uint32_t id = frame.id | (frame.extended ? blf::extended_id : 0U);
  const auto append_data = [&](std::size_t room) {
    std::array<std::uint8_t, Frame::max_size> data{};
    if (!entry.remote) std::ranges::copy(frame.payload(), data.begin());
    bytes.append(reinterpret_cast<const char*>(data.data()), room);
  };
  append(bytes, channel);
  if (frame.error) {
    append(bytes, std::uint16_t{0});
    append(bytes, std::uint32_t{0});
    append(bytes, std::uint16_t{0});
    append(bytes, static_cast<std::uint16_t>(frame.size));
    append(bytes, std::uint32_t{0});
    append(bytes, id);
    append(bytes, std::uint32_t{0});
    append_data(8);
    return blf::can_error_ext;
  }
  append(bytes, static_cast<std::uint8_t>((entry.transmitted ? blf::message_sent : 0) |
                                          (entry.remote ? blf::message_remote : 0)));
  append(bytes, static_cast<std::uint8_t>(dlc_of(frame.size)));
  append(bytes, id);
  if (!frame.fd) {
    append_data(8);
    return blf::can_message;
  }
  append(bytes, std::uint32_t{0});
  append(bytes, std::uint8_t{0});
  append(bytes, static_cast<std::uint8_t>(blf::fd_edl | (frame.brs ? blf::fd_brs : 0) |
                                          (frame.esi ? blf::fd_esi : 0)));
  append(bytes, frame.size);
  bytes.append(5, '\0');
  append_data(Frame::max_size);
  return blf::can_fd_message;
}

class BlfSink final : public LogSink {
 public:
  explicit BlfSink(File file) : file_(std::move(file)) {}

  void write(const LogEntry& entry) override {
    if (objects_ == 0) begin(entry.t_ns);
    last_ns_ = std::max(entry.t_ns, last_ns_);
    const auto channel = static_cast<std::uint16_t>(channel_of(entry.interface));
    body_.clear();
    const blf::Type type = append_body(body_, entry, channel);
    append_object(type, static_cast<std::uint64_t>(std::max<std::int64_t>(entry.t_ns - start_ns_, 0)));
  }

  int close() override {
    if (objects_ == 0) begin(0);
    write_container();
    if (error_ == 0 && std::fseek(file_.get(), 0, SEEK_SET) != 0) error_ = errno;
    put(file_header());
    if (file_ && std::fclose(file_.release()) != 0 && error_ == 0) error_ = errno;
    return error_;
  }

 private:
  void begin(std::int64_t t_ns) {
    start_ns_ = last_ns_ = t_ns - t_ns % ns_per_ms;  // the header has milliseconds
    put(file_header());
    written_ = blf::file_header_size;
  }

  void put(std::string_view bytes) {
    if (error_ == 0 && std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
      error_ = errno;
  }

  void append_object(blf::Type type, std::uint64_t time_ns) {
    append_base_header(content_, blf::header_size, blf::header_size + body_.size(), type);
    append(content_, std::uint32_t{2});  // the time is in ns
    append(content_, std::uint32_t{0});
    append(content_, time_ns);
    content_ += body_;
    content_.append(body_.size() % 4, '\0');
    ++objects_;
    if (content_.size() >= container_size) write_container();
  }

  void write_container() {
    if (content_.empty()) return;
    uLongf size = compressBound(content_.size());
    compressed_.resize(size);
    compress2(compressed_.data(), &size, reinterpret_cast<const Bytef*>(content_.data()), content_.size(),
              Z_BEST_SPEED);
    std::string header;
    const std::size_t object_size = blf::base_header_size + blf::container_header_size + size;
    append_base_header(header, blf::base_header_size, object_size, blf::log_container);
    append(header, std::uint16_t{2});
    header.append(6, '\0');
    append(header, static_cast<std::uint32_t>(content_.size()));
    header.append(4, '\0');
    put(header);
    put({reinterpret_cast<const char*>(compressed_.data()), size});
    put(std::string(object_size % 4, '\0'));
    written_ += object_size + object_size % 4;
    uncompressed_ += blf::base_header_size + blf::container_header_size + content_.size();
    content_.clear();
  }

  [[nodiscard]] std::string file_header() const {
    std::string bytes = "LOGG";
    append(bytes, static_cast<std::uint32_t>(blf::file_header_size));
    // An unknown program with version 0.0.0, and version 2.6.8.1 of the format.
    bytes.append("\0\0\0\0\2\6\10\1", 8);
    append(bytes, static_cast<std::uint64_t>(written_));
    append(bytes, static_cast<std::uint64_t>(uncompressed_));
    append(bytes, objects_);
    append(bytes, std::uint32_t{0});
    append_system_time(bytes, start_ns_);
    append_system_time(bytes, last_ns_);
    bytes.resize(blf::file_header_size, '\0');
    return bytes;
  }

  std::size_t channel_of(const std::string& interface) {
    const auto found = std::ranges::find(interfaces_, interface);
    const auto channel = static_cast<std::size_t>(found - interfaces_.begin()) + 1;
    if (found != interfaces_.end()) return channel;
    interfaces_.push_back(interface);
    const std::string text = ";" + interface;  // without a database
    body_.clear();
    append(body_, blf::channel_text);
    append(body_, static_cast<std::uint32_t>(blf::bus_type_can << 16U | (channel & 0xFFU) << 8U));
    append(body_, static_cast<std::uint32_t>(text.size()));
    append(body_, std::uint32_t{0});
    body_ += text;
    append_object(blf::app_text, 0);
    return channel;
  }

  File file_;
  int error_ = 0;
  std::string content_, body_;
  std::vector<Bytef> compressed_;
  std::vector<std::string> interfaces_;
  std::int64_t start_ns_ = 0, last_ns_ = 0;
  std::uint32_t objects_ = 0;
  std::size_t written_ = blf::file_header_size, uncompressed_ = blf::file_header_size;
};

}  // namespace

std::unique_ptr<LogSink> blf_sink(File file) { return std::make_unique<BlfSink>(std::move(file)); }

}  // namespace canhil::logs
