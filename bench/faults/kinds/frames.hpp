// Frames that are lost, repeated, or changed in form on their way to the bus.
#pragma once

#include "bench/faults/of_frames.hpp"
#include "bench/faults/rule.hpp"

namespace canhil::faults {

/// Shared by all kinds of frame faults.
struct Frames {
  static constexpr Stage stage = Stage::bus;
  OfMessages of{};
  When when{};
  [[nodiscard]] std::string subject() const { return of.text; }
};

/// A kind whose function `Kind::change` changes each frame independently of the other frames.
template <class Kind>
struct EachFrame : Frames {
  static Kind read(scenario::Section& section, const scenario::FaultContext& context) {
    Kind kind;
    kind.of = read_messages(section, context);
    kind.when = read_when(section, context, Repeats::each);
    return kind;
  }
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const {
    return change_frames(of, when, run, &Kind::change);
  }
};

/// The frame is not sent.
struct Lost : EachFrame<Lost> {
  static constexpr std::string_view kind = "lost";
  static constexpr std::string_view meaning = "The frame is not sent.";
  static void change(const MessageInfo& message, const Frame& frame, std::vector<Frame>& left);
};

/// The frame is sent twice.
struct Repetition : EachFrame<Repetition> {
  static constexpr std::string_view kind = "repeated";
  static constexpr std::string_view meaning = "The frame is sent twice.";
  static void change(const MessageInfo& message, const Frame& frame, std::vector<Frame>& left);
};

/// The frame lacks its last byte.
struct TooShort : EachFrame<TooShort> {
  static constexpr std::string_view kind = "too_short";
  static constexpr std::string_view meaning = "The frame lacks its last byte.";
  static void change(const MessageInfo& message, const Frame& frame, std::vector<Frame>& left);
};

/// The frame has additional bytes, all zero.
struct TooLong : EachFrame<TooLong> {
  static constexpr std::string_view kind = "too_long";
  static constexpr std::string_view meaning = "The frame has more bytes than the message.";
  static void change(const MessageInfo& message, const Frame& frame, std::vector<Frame>& left);
  [[nodiscard]] std::string cannot(const Place& place) const;
};

/// The frame is extended, with a 29-bit id.
struct ForeignFormat : EachFrame<ForeignFormat> {
  static constexpr std::string_view kind = "foreign";
  static constexpr std::string_view meaning =
      "The frame is sent as an extended frame, with an id of 29 bits.";
  static void change(const MessageInfo& message, const Frame& frame, std::vector<Frame>& left);
};

/// Bits of the payload are flipped, the CRC is unchanged.
struct Damaged : Frames {
  static constexpr std::string_view kind = "damaged";
  static constexpr std::string_view meaning =
      "One or more bits of the payload are flipped, and the CRC is not recomputed.";
  std::optional<std::int64_t> bits{};  ///< number of random bits; none: one fixed bit
  static Damaged read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

}  // namespace canhil::faults
