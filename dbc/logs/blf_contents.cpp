#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>

#include "dbc/logs/blf.hpp"
#include "dbc/logs/little_endian.hpp"

namespace canhil::logs::blf {
namespace {

constexpr std::string_view signature = "LOBJ";
std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

class Contents final : public Bytes {
 public:
  explicit Contents(Input input) : input_(std::move(input)) {}
  Contents(const Contents&) = delete;
  Contents& operator=(const Contents&) = delete;
  ~Contents() override {
    if (inflating_) inflateEnd(&stream_);
  }

  Result<std::size_t> read(std::span<char> to) override {
    for (;;) {
      if (rest_ == 0 && !inflating_) {
        const auto began = begin();
        if (!began) return tl::unexpected(began.error());
        if (!*began) return std::size_t{0};
        continue;
      }
      Result<std::string_view> some{};
      if (rest_ > 0) some = input_.available();
      if (!some) return tl::unexpected(some.error());
      if (some->empty() && rest_ > 0) return failure("its last object is cut");
      const std::string_view from = some->substr(0, std::min<std::size_t>(rest_, some->size()));
      auto got = inflating_ ? inflate_some(from, to) : copy(from, to);
      if (!got || *got > 0) return got;
    }
  }

 private:
  // Begins the next object of the file; false: there is none. An object that is not a container is a part of
  // the stream itself: files without compression may have no containers.
  Result<bool> begin() {
    const auto header = next_header(input_);
    if (!header) return tl::unexpected(header.error());
    if (!*header) return false;
    rest_ = (*header)->object_size;
    if ((*header)->type != log_container) return true;
    std::array<char, container_header_size> fields{};
    const bool complete = rest_ >= (*header)->size + fields.size();
    auto skipped = complete ? input_.skip((*header)->size) : Result<bool>(false);
    if (!skipped) return skipped;
    auto got = *skipped ? input_.read(fields) : Result<bool>(false);
    if (!got) return got;
    if (!*got) return failure("its last object is cut");
    rest_ -= (*header)->size + fields.size();
    const auto method = little_endian<std::uint16_t>(bytes_of({fields.data(), fields.size()}), 0);
    constexpr std::uint16_t none = 0, zlib = 2;
    if (method != none && method != zlib)
      return failure(fmt::format("compression method {}, expected 0 (none) or 2 (zlib)", method));
    if (method == zlib) {
      stream_ = {};
      if (inflateInit(&stream_) != Z_OK) return failure("no memory to decompress it");
      inflating_ = true;
    }
    return true;
  }

  Result<std::size_t> copy(std::string_view from, std::span<char> to) {
    const std::size_t size = std::min(from.size(), to.size());
    std::copy_n(from.data(), size, to.data());
    input_.take(size);
    rest_ -= size;
    return size;
  }

  Result<std::size_t> inflate_some(std::string_view from, std::span<char> to) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(from.data()));
    stream_.avail_in = static_cast<uInt>(from.size());
    stream_.next_out = reinterpret_cast<Bytef*>(to.data());
    stream_.avail_out = static_cast<uInt>(to.size());
    const int state = inflate(&stream_, Z_NO_FLUSH);
    const std::size_t used = from.size() - stream_.avail_in, got = to.size() - stream_.avail_out;
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
      return failure(std::string("its compressed data are damaged: ") +
                     (stream_.msg != nullptr ? stream_.msg : "unknown error"));
    input_.take(used);
    rest_ -= used;
    if (state == Z_STREAM_END) {  // bytes behind the compressed data are of no use
      inflateEnd(&stream_);
      inflating_ = false;
      const auto skipped = input_.skip(rest_);
      if (!skipped) return tl::unexpected(skipped.error());
      rest_ = 0;
    } else if (used == 0 && got == 0) {
      return failure("its compressed data end too early");
    }
    return got;
  }

  Input input_;
  std::size_t rest_ = 0;  // bytes of the object that have not been read
  bool inflating_ = false;
  z_stream stream_{};
};

}  // namespace

Result<std::optional<Header>> next_header(Input& input) {
  constexpr std::size_t most_padding = 7;
  for (std::size_t padding = 0;;) {
    const auto head = input.peek(base_header_size);
    if (!head) return tl::unexpected(head.error());
    if (head->starts_with(signature)) {
      if (head->size() < base_header_size) return failure("its last object is cut");
      const auto bytes = bytes_of(*head);
      const Header header{.size = little_endian<std::uint16_t>(bytes, 4),
                          .object_size = little_endian<std::uint32_t>(bytes, 8),
                          .type = little_endian<std::uint32_t>(bytes, 12)};
      if (header.size < base_header_size || header.object_size < header.size)
        return failure("expected an object whose size is that of its header, or more");
      return std::optional(header);
    }
    if (head->empty()) return std::optional<Header>();
    if (head->size() < signature.size() && padding + head->size() <= most_padding) {
      input.take(head->size());
      return std::optional<Header>();
    }
    // Any number of zeros may fill a container.
    if (head->front() != '\0' && ++padding > most_padding)
      return failure("expected an object, which begins with LOBJ");
    input.take(1);
  }
}

std::unique_ptr<Bytes> contents_of_containers(Input input) {
  return std::make_unique<Contents>(std::move(input));
}

}  // namespace canhil::logs::blf
