#include "bench/recordings/decode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "bench/recordings/message_finder.hpp"
#include "dbc/logs/log.hpp"
#include "dbc/transport/fast_packet.hpp"
#include "dbc/transport/j1939.hpp"

namespace canhil::recordings {
namespace {

std::string time_text(std::int64_t t_ns) {
  // t_ns is negative if a stamp is earlier than the first stamp.
  const std::int64_t size_ns = std::abs(t_ns);
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  std::string text = fmt::format("{}{}.{:09}", t_ns < 0 ? "-" : "", size_ns / ns_per_s, size_ns % ns_per_s);
  if (text.ends_with("000")) text.resize(text.size() - 3);
  return text;
}

class Decoder {
 public:
  Decoder(const dbc::Database& database, const DecodeOptions& options, const Sink& give)
      : options_(options),
        finder_(database, options.j1939),
        writer_(line_writer(options.format, database, finder_.any_group(), give)) {}

  void take(const LogEntry& entry) {
    if (!first_ns_) first_ns_ = options_.since_1970 ? 0 : entry.t_ns;
    const bool carries = finder_.any_group() && transport::J1939Receiver::carries(entry.frame);
    const auto found = finder_.find(entry.frame);
    // The DBC may also have the frames of the transport protocol as messages.
    if (!carries || found.match == MessageFinder::Match::found) take(entry, found, entry.frame.payload());
    if (!carries) return;
    if (const auto whole = transports_[entry.interface].take(entry.frame)) {
      LogEntry of = entry;
      of.frame = {.id = whole->id, .extended = true};
      take(of, finder_.find(of.frame), whole->bytes);
    }
  }
  LeftOut finish() {
    writer_->finish();
    for (const auto& [id, receiver] : fast_packets_)
      left_out_.incomplete += receiver.lost() + receiver.open();
    for (const auto& [interface, receiver] : transports_)
      left_out_.incomplete += receiver.lost() + receiver.open();
    return std::move(left_out_);
  }
  [[nodiscard]] bool any_group() const { return finder_.any_group(); }

 private:
  // `bytes`: of the frame, or of a message that J1939 sent in several frames.
  void take(const LogEntry& entry, const MessageFinder::Found& found, std::span<const std::uint8_t> bytes) {
    const Frame& frame = entry.frame;
    const auto [match, message, is_group] = found;
    if (match == MessageFinder::Match::none) {
      ++left_out_.frames;
      left_out_.ids.insert(frame.error ? "error frames" : id_text(frame));
    } else if (match == MessageFinder::Match::ambiguous) {
      ++left_out_.ambiguous;
      left_out_.ambiguous_ids.insert(id_text(frame));
    } else if (is_selected(*message)) {
      if (message->fast_packet && !frame.fd) {
        const auto whole = fast_packets_[{entry.interface, frame.id}].take(bytes);
        if (!whole) return;
        bytes = *whole;
      }
      const std::vector<SignalValue> values = decoder_.decode(*message, bytes);
      const auto missing = std::ranges::count_if(values, [](const SignalValue& v) { return v.text.empty(); });
      left_out_.short_frames += missing > 0 ? 1 : 0;
      left_out_.missing += static_cast<std::uint64_t>(missing);
      const std::string t_s = time_text(entry.t_ns - *first_ns_);
      writer_->write(
          {.entry = entry, .message = *message, .is_group = is_group, .t_s = t_s, .values = values});
    }
  }
  static std::string id_text(const Frame& frame) {
    return fmt::format("{:0{}X}", frame.id, frame.extended ? 8 : 3);
  }
  [[nodiscard]] bool is_selected(const dbc::Message& message) const {
    return options_.only.empty() || std::ranges::find(options_.only, message.name) != options_.only.end();
  }

  const DecodeOptions& options_;
  MessageFinder finder_;
  FrameDecoder decoder_;
  std::map<std::pair<std::string, std::uint32_t>, transport::FastPacketReceiver>
      fast_packets_;                                            // by interface and id
  std::map<std::string, transport::J1939Receiver> transports_;  // by interface
  std::unique_ptr<LineWriter> writer_;
  std::optional<std::int64_t> first_ns_;  // the time that is written as 0
  LeftOut left_out_;
};

}  // namespace

Result<LeftOut> decode(const std::string& log, const dbc::Database& database, const DecodeOptions& options,
                       const Sink& give) {
  for (const std::string& name : options.only) {
    if (dbc::find_message(database, name) == nullptr)
      return failure(fmt::format("--only '{}': the DBC has no such message, expected one that it has", name));
  }
  Decoder decoder(database, options, give);
  if (options.j1939 && !decoder.any_group())
    return failure("--j1939: the DBC has no message with a 29-bit id, expected at least one");
  auto reader = LogReader::open(log);
  if (!reader) return tl::unexpected(reader.error());
  for (;;) {
    const auto entry = reader->next();
    if (!entry) return tl::unexpected(entry.error());
    if (!*entry) return decoder.finish();
    decoder.take(**entry);
  }
}

}  // namespace canhil::recordings
