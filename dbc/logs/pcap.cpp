// Captures in the format of libpcap, with link type SocketCAN (LINKTYPE_CAN_SOCKETCAN, 227). A packet has a
// header of eight bytes, then the data. The header has the id with SocketCAN's flags (big-endian), the
// length, the FD flags, and two zero bytes.
#include "dbc/logs/pcap.hpp"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "dbc/logs/formats.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::logs {
namespace {

constexpr std::size_t header_size = 8;
constexpr std::uint32_t flag_extended = 0x8000'0000, flag_remote = 0x4000'0000, flag_error = 0x2000'0000;
constexpr std::uint8_t flag_brs = 1, flag_fd = 4;

struct CloseCapture {
  void operator()(pcap_t* capture) const { pcap_close(capture); }
};
using Capture = std::unique_ptr<pcap_t, CloseCapture>;

class PcapSink final : public LogSink {
 public:
  explicit PcapSink(File file)
      : capture_(pcap_open_dead_with_tstamp_precision(DLT_CAN_SOCKETCAN, header_size + Frame::max_size,
                                                      PCAP_TSTAMP_PRECISION_NANO)),
        dump_(pcap_dump_fopen(capture_.get(), file.get())) {
    if (dump_ != nullptr)
      static_cast<void>(file.release());  // dump_ closes the file
    else
      error_ = errno;  // the header of the file could not be written
  }

  void write(const LogEntry& entry) override {
    if (error_ != 0) return;
    const Frame& frame = entry.frame;
    std::array<std::uint8_t, header_size + Frame::max_size> packet{};
    const std::uint32_t id =
        frame.id | (frame.extended ? flag_extended : 0U) | (frame.error ? flag_error : 0U);
    for (std::size_t i = 0; i < 4; ++i) packet[i] = static_cast<std::uint8_t>(id >> (24 - 8 * i));
    packet[4] = frame.size;
    if (frame.fd) packet[5] = static_cast<std::uint8_t>(flag_fd | (frame.brs ? flag_brs : 0));
    std::ranges::copy(frame.payload(), packet.begin() + header_size);
    const auto size = static_cast<bpf_u_int32>(header_size + frame.size);
    pcap_pkthdr header{};
    header.ts.tv_sec = entry.t_ns / ns_per_s;
    header.ts.tv_usec = entry.t_ns % ns_per_s;  // in nanoseconds, which is the precision of the capture
    header.caplen = header.len = size;
    pcap_dump(reinterpret_cast<u_char*>(dump_), &header, packet.data());
    if (std::ferror(pcap_dump_file(dump_)) != 0) error_ = errno;
  }
  int close() override {
    if (dump_ == nullptr) return error_;
    if (pcap_dump_flush(dump_) != 0 && error_ == 0) error_ = errno;
    pcap_dump_close(dump_);
    dump_ = nullptr;
    return error_;
  }
  ~PcapSink() override { PcapSink::close(); }

 private:
  Capture capture_;
  pcap_dumper_t* dump_;
  int error_ = 0;
};

class PcapSource final : public LogSource {
 public:
  PcapSource(Capture capture, std::string path) : capture_(std::move(capture)), path_(std::move(path)) {}

  Result<std::optional<LogEntry>> next() override {
    for (;;) {
      pcap_pkthdr* header = nullptr;
      const u_char* bytes = nullptr;
      const int read = pcap_next_ex(capture_.get(), &header, &bytes);
      if (read == PCAP_ERROR_BREAK) return std::optional<LogEntry>();
      ++number_;
      if (read != 1)
        return failure(fmt::format("{}: packet {}: {}", path_, number_, pcap_geterr(capture_.get())));
      auto frame = frame_of_packet({bytes, header->caplen});
      if (!frame) return failure(fmt::format("{}: packet {}: {}", path_, number_, frame.error().message));
      if (!*frame) continue;
      return std::optional(LogEntry{
          .t_ns = header->ts.tv_sec * ns_per_s + header->ts.tv_usec, .interface = "can0", .frame = **frame});
    }
  }

 private:
  Capture capture_;
  std::string path_;
  std::size_t number_ = 0;
};

}  // namespace

Result<std::optional<Frame>> frame_of_packet(std::span<const std::uint8_t> packet) {
  if (packet.size() < header_size)
    return failure(fmt::format("{} bytes, expected a header of {}", packet.size(), header_size));
  std::uint32_t id = 0;
  for (std::size_t i = 0; i < 4; ++i) id = id << 8U | packet[i];
  if ((id & flag_remote) != 0) return std::optional<Frame>();
  const std::size_t size = packet[4];
  Frame frame{.id = id & max_extended_id,
              .extended = (id & flag_extended) != 0,
              .fd = (packet[5] & flag_fd) != 0 || size > 8,
              .error = (id & flag_error) != 0};
  frame.brs = frame.fd && (packet[5] & flag_brs) != 0;
  if (size > Frame::max_size || size > packet.size() - header_size)
    return failure(fmt::format("{} bytes of data, expected {}", packet.size() - header_size, size));
  frame.size = static_cast<std::uint8_t>(size);
  if (!can_carry(frame, true))
    return failure(fmt::format("id {:X} with {} bytes, expected a frame of CAN or CAN FD", frame.id, size));
  std::ranges::copy(packet.subspan(header_size, size), frame.data.begin());
  return std::optional(frame);
}

std::unique_ptr<LogSink> pcap_sink(File file) { return std::make_unique<PcapSink>(std::move(file)); }

Result<std::unique_ptr<LogSource>> pcap_source(const std::string& path) {
  std::array<char, PCAP_ERRBUF_SIZE> why{};
  Capture capture(
      pcap_open_offline_with_tstamp_precision(path.c_str(), PCAP_TSTAMP_PRECISION_NANO, why.data()));
  if (!capture) return failure(fmt::format("cannot read log '{}': {}", path, why.data()));
  if (const int link = pcap_datalink(capture.get()); link != DLT_CAN_SOCKETCAN) {
    const char* name = pcap_datalink_val_to_name(link);
    return failure(fmt::format("cannot read log '{}': its link type is {}, expected CAN_SOCKETCAN", path,
                               name == nullptr ? std::to_string(link) : name));
  }
  return std::make_unique<PcapSource>(std::move(capture), path);
}

}  // namespace canhil::logs
