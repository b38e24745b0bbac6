// Writes captures in the format of libpcap, with link type SocketCAN.
#include "dbc/logs/pcap.hpp"

#include <pcap/pcap.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "dbc/logs/formats.hpp"
#include "dbc/logs/words.hpp"

namespace canhil::logs {
namespace {

constexpr std::size_t header_size = socketcan_header_size;

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
    const std::uint32_t id = frame.id | (frame.extended ? socketcan_extended : 0U) |
                             (frame.error ? socketcan_error : 0U) | (entry.remote ? socketcan_remote : 0U);
    for (std::size_t i = 0; i < 4; ++i) packet[i] = static_cast<std::uint8_t>(id >> (24 - 8 * i));
    packet[4] = frame.size;
    if (frame.fd)
      packet[5] = static_cast<std::uint8_t>(socketcan_fd | (frame.brs ? socketcan_brs : 0) |
                                            (frame.esi ? socketcan_esi : 0));
    if (!entry.remote) std::ranges::copy(frame.payload(), packet.begin() + header_size);
    const auto size = static_cast<bpf_u_int32>(header_size + (entry.remote ? 0 : frame.size));
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

}  // namespace

std::unique_ptr<LogSink> pcap_sink(File file) { return std::make_unique<PcapSink>(std::move(file)); }

}  // namespace canhil::logs
