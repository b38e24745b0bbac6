// The conversions of an input: gzip and UTF-16.
#include <zlib.h>

#include <array>
#include <optional>

#include "dbc/logs/input.hpp"

namespace canhil::logs {
namespace {

class Gunzip final : public Bytes {
 public:
  explicit Gunzip(std::unique_ptr<Bytes> from) : from_(std::move(from)) {
    constexpr int gzip_only = 16;
    ready_ = inflateInit2(&stream_, MAX_WBITS + gzip_only) == Z_OK;
  }
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;
  ~Gunzip() override { inflateEnd(&stream_); }

  Result<std::size_t> read(std::span<char> to) override {
    if (!ready_) return failure("no memory to decompress it");
    stream_.next_out = reinterpret_cast<Bytef*>(to.data());
    stream_.avail_out = static_cast<uInt>(to.size());
    while (stream_.avail_out == to.size()) {
      if (stream_.avail_in == 0) {
        auto got = from_->read(compressed_);
        if (!got) return got;
        if (*got == 0) {
          if (between_members_) return std::size_t{0};
          return failure("its gzip data end too early: the file is cut");
        }
        stream_.next_in = reinterpret_cast<Bytef*>(compressed_.data());
        stream_.avail_in = static_cast<uInt>(*got);
      }
      if (between_members_ && skips_padding()) continue;
      between_members_ = false;
      const int state = inflate(&stream_, Z_NO_FLUSH);
      if (state == Z_STREAM_END) {
        between_members_ = true;
        inflateReset(&stream_);
      } else if (state != Z_OK && state != Z_BUF_ERROR) {
        return failure(std::string("its gzip data are damaged: ") +
                       (stream_.msg != nullptr ? stream_.msg : "unknown error"));
      }
    }
    return to.size() - stream_.avail_out;
  }

 private:
  // A member may be followed by zero bytes that fill a block of a medium.
  bool skips_padding() {
    while (stream_.avail_in > 0 && *stream_.next_in == 0) {
      ++stream_.next_in;
      --stream_.avail_in;
    }
    return stream_.avail_in == 0;
  }

  std::unique_ptr<Bytes> from_;
  z_stream stream_{};
  bool ready_ = false;
  bool between_members_ = false;  // true: a member has ended and no other has begun
  std::array<char, 1 << 15> compressed_{};
};

class Utf8OfUtf16 final : public Bytes {
 public:
  Utf8OfUtf16(std::unique_ptr<Bytes> from, bool big_endian)
      : from_(std::move(from)), big_endian_(big_endian) {}

  Result<std::size_t> read(std::span<char> to) override {
    while (taken_ == ready_.size()) {
      ready_.clear();
      taken_ = 0;
      auto got = from_->read(units_);
      if (!got) return got;
      if (*got == 0) {
        if (!high_ && !odd_) return std::size_t{0};
        put(replacement);  // the text ends within a character
        high_.reset();
        odd_.reset();
      }
      for (std::size_t i = 0; i < *got; ++i) byte(static_cast<std::uint8_t>(units_.at(i)));
    }
    const std::size_t size = std::min(to.size(), ready_.size() - taken_);
    std::copy_n(ready_.data() + taken_, size, to.data());
    taken_ += size;
    return size;
  }

 private:
  static constexpr std::uint32_t replacement = 0xFFFD;

  void byte(std::uint8_t value) {
    if (!odd_) {
      odd_ = value;
      return;
    }
    const std::uint32_t unit = big_endian_ ? (*odd_ << 8U) | value : (std::uint32_t{value} << 8U) | *odd_;
    odd_.reset();
    const bool is_high = unit >= 0xD800 && unit < 0xDC00, is_low = unit >= 0xDC00 && unit < 0xE000;
    if (high_ && is_low) {
      put(0x1'0000 + ((*high_ - 0xD800) << 10U) + (unit - 0xDC00));
      high_.reset();
      return;
    }
    if (high_) put(replacement);
    high_.reset();
    if (is_high)
      high_ = unit;
    else
      put(is_low ? replacement : unit);
  }
  void put(std::uint32_t code_point) {
    const auto tail = [&](unsigned shift) {
      ready_.push_back(static_cast<char>(0x80U | ((code_point >> shift) & 0x3FU)));
    };
    if (code_point < 0x80) {
      ready_.push_back(static_cast<char>(code_point));
    } else if (code_point < 0x800) {
      ready_.push_back(static_cast<char>(0xC0U | (code_point >> 6U)));
      tail(0);
    } else if (code_point < 0x1'0000) {
      ready_.push_back(static_cast<char>(0xE0U | (code_point >> 12U)));
      tail(6);
      tail(0);
    } else {
      ready_.push_back(static_cast<char>(0xF0U | (code_point >> 18U)));
      tail(12);
      tail(6);
      tail(0);
    }
  }

  std::unique_ptr<Bytes> from_;
  bool big_endian_;
  std::array<char, 1 << 14> units_{};
  std::optional<std::uint8_t> odd_;    // the first byte of a code unit
  std::optional<std::uint32_t> high_;  // the first half of a pair of surrogates
  std::string ready_;
  std::size_t taken_ = 0;
};

}  // namespace

std::unique_ptr<Bytes> gunzip(std::unique_ptr<Bytes> from) {
  return std::make_unique<Gunzip>(std::move(from));
}

std::unique_ptr<Bytes> utf8_of_utf16(std::unique_ptr<Bytes> from, bool big_endian) {
  return std::make_unique<Utf8OfUtf16>(std::move(from), big_endian);
}

}  // namespace canhil::logs
