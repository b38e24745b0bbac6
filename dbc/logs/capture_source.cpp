// Reads captures in the formats pcap and pcapng. A pcapng file consists of blocks in sections; each section
// may have another byte order and several interfaces. Sources: draft-ietf-opsawg-pcap,
// draft-ietf-opsawg-pcapng.
#include <fmt/format.h>
#include <pcap/pcap.h>

#include <array>
#include <bit>
#include <vector>

#include "dbc/logs/pcap.hpp"
#include "dbc/logs/words.hpp"

namespace canhil::logs {
namespace {

constexpr std::uint32_t longest_packet = 1 << 18;  // of any link type; also the longest block of pcapng
constexpr std::string_view other_link = "packets of other link types than SocketCAN, SLL and SLL2";

// Numbers in the byte order of a file or section.
class Fields {
 public:
  explicit Fields(bool big_endian) : big_endian_(big_endian) {}
  [[nodiscard]] std::uint32_t u32(std::span<const std::uint8_t> bytes, std::size_t at) const {
    return big_endian_ ? u16(bytes, at) << 16U | u16(bytes, at + 2)
                       : u16(bytes, at) | u16(bytes, at + 2) << 16U;
  }
  [[nodiscard]] std::uint64_t u64(std::span<const std::uint8_t> bytes, std::size_t at) const {
    const std::uint64_t first = u32(bytes, at), second = u32(bytes, at + 4);
    return big_endian_ ? first << 32U | second : first | second << 32U;
  }
  [[nodiscard]] std::uint32_t u16(std::span<const std::uint8_t> bytes, std::size_t at) const {
    const std::uint32_t first = bytes[at], second = bytes[at + 1];
    return big_endian_ ? first << 8U | second : first | second << 8U;
  }

 private:
  bool big_endian_;
};

// What both formats share: the input, the packet that was read last, and its number.
class CaptureSource : public LogSource {
 public:
  explicit CaptureSource(Input input) : input_(std::move(input)) {}
  [[nodiscard]] std::string last() const override {
    return fmt::format("{}: packet {}", input_.name(), number_);
  }
  [[nodiscard]] bool recognised() const override { return recognised_; }

 protected:
  [[nodiscard]] tl::unexpected<Error> at_packet(std::string_view what) const {
    return failure(fmt::format("{}: packet {}: {}", input_.name(), number_, what));
  }
  // Reads `size` bytes into `bytes_`; false: the input ends at once.
  Result<bool> read(std::size_t size) {
    bytes_.resize(size);
    const auto begins = input_.available();
    if (!begins) return tl::unexpected(begins.error());
    if (begins->empty() && size > 0) return false;
    auto whole = input_.read({reinterpret_cast<char*>(bytes_.data()), size});
    if (!whole) return whole;
    if (!*whole) return at_packet("the file is cut, expected the rest of the packet");
    return true;
  }
  // The frame in a packet, which had `whole_size` bytes on the wire; nullopt: it was left out.
  Result<std::optional<LogEntry>> entry_of(std::uint16_t link, std::span<const std::uint8_t> packet,
                                           std::size_t whole_size, std::int64_t t_ns,
                                           const std::string& interface) {
    auto parsed = frame_of_packet(link, packet);
    if (!parsed && packet.size() < whole_size)
      parsed = Parsed{.left_out = "packets that the capture contains only in part (snap length)"};
    if (!parsed) return at_packet(parsed.error().message);
    if (!parsed->left_out.empty()) leave_out(parsed->left_out);
    if (!parsed->entry) return std::optional<LogEntry>();
    parsed->entry->t_ns = t_ns;
    if (parsed->entry->interface.empty()) parsed->entry->interface = interface;
    return std::move(parsed->entry);
  }

  Input input_;
  std::vector<std::uint8_t> bytes_;
  std::size_t number_ = 0;
  bool recognised_ = false;
};

class PcapSource final : public CaptureSource {
 public:
  PcapSource(Input input, Fields fields, std::int64_t unit_ns, std::uint16_t link)
      : CaptureSource(std::move(input)), fields_(fields), unit_ns_(unit_ns), link_(link) {
    recognised_ = true;
  }

  Result<std::optional<LogEntry>> next() override {
    constexpr std::size_t header_size = 16;
    for (;;) {
      ++number_;
      const auto header = read(header_size);
      if (!header) return tl::unexpected(header.error());
      if (!*header) return std::optional<LogEntry>();
      const std::int64_t t_ns = fields_.u32(bytes_, 0) * ns_per_s + fields_.u32(bytes_, 4) * unit_ns_;
      const std::uint32_t size = fields_.u32(bytes_, 8), whole_size = fields_.u32(bytes_, 12);
      if (size > longest_packet)
        return at_packet(fmt::format("{} bytes, expected {} at most", size, longest_packet));
      const auto packet = read(size);
      if (!packet) return tl::unexpected(packet.error());
      if (!*packet) return at_packet("the file is cut, expected the rest of the packet");
      auto entry = entry_of(link_, bytes_, whole_size, t_ns, "can0");
      if (!entry || *entry) return entry;
    }
  }

 private:
  Fields fields_;
  std::int64_t unit_ns_;
  std::uint16_t link_;
};

class PcapngSource final : public CaptureSource {
 public:
  using CaptureSource::CaptureSource;

  Result<std::optional<LogEntry>> next() override {
    for (;;) {
      const auto type = read_block();
      if (!type) return tl::unexpected(type.error());
      if (!*type) return std::optional<LogEntry>();
      auto entry = block(**type);
      if (!entry || *entry) return entry;
    }
  }

 private:
  enum Type : std::uint32_t {
    section = 0x0A0D'0D0A,
    interface_description = 1,
    old_packet = 2,
    simple_packet = 3,
    enhanced_packet = 6
  };
  struct Interface {
    std::uint16_t link = 0;
    std::string name;
    std::uint64_t per_second = 1'000'000;  // units of the time stamp in a second
    std::int64_t offset_s = 0;
  };

  // Reads the body of the next block into `bytes_`; the type of the block, nullopt: the file has ended.
  Result<std::optional<std::uint32_t>> read_block() {
    constexpr std::size_t around = 12;  // the type, and the length before and after the body
    const auto head = read(8);
    if (!head) return tl::unexpected(head.error());
    if (!*head) return std::optional<std::uint32_t>();
    const bool new_section = fields_.u32(bytes_, 0) == section;  // the same in both byte orders
    if (new_section) {
      const auto order = input_.peek(4);
      if (!order) return tl::unexpected(order.error());
      fields_ = Fields(*order == "\x1A\x2B\x3C\x4D");
      interfaces_.clear();
    }
    const std::uint32_t type = fields_.u32(bytes_, 0), length = fields_.u32(bytes_, 4);
    if (length < around || length % 4 != 0 || length - around > longest_packet)
      return at_packet(fmt::format("a block of {} bytes, expected {} at most", length, longest_packet));
    const auto body = read(length - around);
    if (!body) return tl::unexpected(body.error());
    const auto tail = input_.skip(*body ? 4 : 0);
    if (!tail) return tl::unexpected(tail.error());
    if (!*body || !*tail) return at_packet("the file is cut, expected the rest of the block");
    if (new_section && (bytes_.size() < 4 || fields_.u32(bytes_, 0) != 0x1A2B'3C4D))
      return at_packet("a section without the mark of its byte order");
    return std::optional(type);
  }

  Result<std::optional<LogEntry>> block(std::uint32_t type) {
    if (type == interface_description) return describe_interface();
    if (type != enhanced_packet && type != old_packet && type != simple_packet)
      return std::optional<LogEntry>();
    ++number_;
    if (type == simple_packet) {
      leave_out("packets without a time stamp");
      return std::optional<LogEntry>();
    }
    constexpr std::size_t header_size =
        20;  // interface, time stamp (high, low), size in the file, size on the wire
    if (bytes_.size() < header_size) return at_packet("a block without its fields");
    const std::uint32_t index = type == enhanced_packet ? fields_.u32(bytes_, 0) : fields_.u16(bytes_, 0);
    const std::uint32_t size = fields_.u32(bytes_, 12);
    if (index >= interfaces_.size())
      return at_packet(fmt::format("interface {}, expected one that is described", index));
    if (size > bytes_.size() - header_size)
      return at_packet(fmt::format("{} bytes, expected as many as its block has", size));
    const Interface& interface = interfaces_[index];
    if (!is_read(interface.link)) {
      leave_out(other_link);
      return std::optional<LogEntry>();
    }
    recognised_ = true;
    const std::uint64_t time = std::uint64_t{fields_.u32(bytes_, 4)} << 32U | fields_.u32(bytes_, 8);
    const auto t_ns = time_of_stamp(interface, time);
    if (!t_ns) return at_packet("a time after the year 2262");
    const std::span<const std::uint8_t> all(bytes_);
    auto entry = entry_of(interface.link, all.subspan(header_size, size), fields_.u32(bytes_, 16), *t_ns,
                          interface.name);
    if (entry && *entry && interface.link == socketcan) {
      const std::size_t padded = (header_size + size + 3) / 4 * 4;
      (*entry)->transmitted = is_outbound(all.subspan(std::min(padded, all.size())));
    }
    return entry;
  }

  static std::optional<std::int64_t> time_of_stamp(const Interface& interface, std::uint64_t time) {
    const std::uint64_t seconds = time / interface.per_second;
    constexpr std::uint64_t last_s = 9'000'000'000;
    if (seconds > last_s || interface.offset_s < 0 ||
        static_cast<std::uint64_t>(interface.offset_s) > last_s - seconds)
      return std::nullopt;
    const auto fraction =
        static_cast<__uint128_t>(time % interface.per_second) * ns_per_s / interface.per_second;
    return (static_cast<std::int64_t>(seconds) + interface.offset_s) * ns_per_s +
           static_cast<std::int64_t>(fraction);
  }

  // Calls take(code, value) for each option of a block.
  template <class Take>
  void options(std::span<const std::uint8_t> bytes, const Take& take) const {
    while (bytes.size() >= 4) {
      const std::uint32_t code = fields_.u16(bytes, 0), size = fields_.u16(bytes, 2);
      if (code == 0 || size > bytes.size() - 4) return;
      take(code, bytes.subspan(4, size));
      bytes = bytes.subspan(std::min<std::size_t>(bytes.size(), 4 + (size + 3) / 4 * 4));
    }
  }

  [[nodiscard]] bool is_outbound(std::span<const std::uint8_t> option_bytes) const {
    constexpr std::uint32_t flags = 2, outbound = 2;
    bool is = false;
    options(option_bytes, [&](std::uint32_t code, std::span<const std::uint8_t> value) {
      if (code == flags && value.size() == 4) is = (fields_.u32(value, 0) & 3U) == outbound;
    });
    return is;
  }

  Result<std::optional<LogEntry>> describe_interface() {
    constexpr std::size_t header_size = 8;  // link type, 0, longest packet
    constexpr std::size_t most = 65'536;
    if (bytes_.size() < header_size || interfaces_.size() == most)
      return at_packet("a description of an interface without its fields, or one too many");
    Interface interface {
      .link = static_cast<std::uint16_t>(fields_.u16(bytes_, 0)),
      .name = fmt::format("can{}", interfaces_.size())
    };
    options(std::span<const std::uint8_t>(bytes_).subspan(header_size),
            [&](std::uint32_t code, std::span<const std::uint8_t> value) {
              constexpr std::uint32_t name = 2, resolution = 9, offset = 14;
              if (code == name && !value.empty() && value[0] != 0) {
                const std::string_view text(reinterpret_cast<const char*>(value.data()), value.size());
                interface.name = interface_name(text.substr(0, text.find('\0')));
              }
              if (code == resolution && value.size() == 1) set_resolution(interface, value[0]);
              if (code == offset && value.size() == 8)
                interface.offset_s = static_cast<std::int64_t>(fields_.u64(value, 0));
            });
    interfaces_.push_back(std::move(interface));
    return std::optional<LogEntry>();
  }

  // A power of ten, or of two if the highest bit is set.
  static void set_resolution(Interface& interface, std::uint8_t value) {
    constexpr std::uint8_t of_two = 0x80, most_of_two = 63, most_of_ten = 18;
    const unsigned power = value & 0x7FU;
    if ((value & of_two) != 0) {
      interface.per_second = std::uint64_t{1} << std::min<unsigned>(power, most_of_two);
      return;
    }
    interface.per_second = 1;
    for (unsigned i = 0; i < std::min<unsigned>(power, most_of_ten); ++i) interface.per_second *= 10;
  }

  Fields fields_{false};
  std::vector<Interface> interfaces_;
};

}  // namespace

Result<std::unique_ptr<LogSource>> capture_source(Input input) {
  const auto peeked = input.peek(24);
  if (!peeked) return tl::unexpected(peeked.error());
  const std::vector<std::uint8_t> head(peeked->begin(), peeked->end());
  constexpr std::uint8_t first_of_pcapng = 0x0A;
  if (head[0] == first_of_pcapng) return std::make_unique<PcapngSource>(std::move(input));
  const std::string name = input.name();
  if (head.size() < 24)
    return failure(fmt::format("cannot read log '{}': the header of the capture is cut", name));
  const bool big_endian = head[0] == 0xA1;
  const Fields fields(big_endian);
  constexpr std::uint32_t magic_of_nanoseconds = 0xA1B2'3C4D;
  const auto link = static_cast<std::uint16_t>(fields.u32(head, 20) & 0xFFFFU);
  if (!is_read(link)) {
    const char* known = pcap_datalink_val_to_name(link);
    return failure(
        fmt::format("cannot read log '{}': its link type is {}, expected CAN_SOCKETCAN, LINUX_SLL or "
                    "LINUX_SLL2",
                    name, known == nullptr ? std::to_string(link) : known));
  }
  input.take(head.size());
  return std::make_unique<PcapSource>(std::move(input), fields,
                                      fields.u32(head, 0) == magic_of_nanoseconds ? 1 : 1000, link);
}

}  // namespace canhil::logs
