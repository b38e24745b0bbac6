#include "dbc/parser/finding.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace canhil::dbc {
namespace {

constexpr std::size_t most_findings = 10'000;

using enum Severity;

constexpr std::array texts{
    RuleText{Rule::not_a_dbc, "not-a-dbc", error, "the text contains no section of a DBC",
             "the file is refused"},
    RuleText{Rule::unfinished_string, "unfinished-string", error,
             "a string in quotes does not end: it takes the rest of the file", "the file is refused"},
    RuleText{Rule::unreadable_message, "unreadable-message", error,
             "a message or signal (BO_, SG_) is malformed", "the file is refused"},
    RuleText{Rule::too_many_findings, "too-many-findings", error, "10,000 findings",
             "the rest is not read, the file is refused"},
    RuleText{Rule::windows_1252, "windows-1252", note, "the text is not UTF-8", "it is read as Windows-1252"},
    RuleText{Rule::independent_signals, "independent-signals", note,
             "VECTOR__INDEPENDENT_SIG_MSG, id 0xC0000000, holds signals that no frame carries",
             "the message is left out"},
    RuleText{Rule::unreadable_section, "unreadable-section", warning, "a section other than BO_ is malformed",
             "the section is left out"},
    RuleText{Rule::unknown_section, "unknown-section", warning, "a section begins with an unknown word",
             "the section is left out"},
    RuleText{Rule::missing_semicolon, "missing-semicolon", warning, "a section ends without ';'",
             "the section ends where the next one begins"},
    RuleText{Rule::line_comment, "line-comment", warning, "a comment begins with '//'",
             "the rest of the line is left out"},
    RuleText{Rule::unexpected_character, "unexpected-character", warning,
             "a character that the format does not use", "the section with it cannot be read"},
    RuleText{Rule::name_character, "name-character", warning, "a name holds letters beyond a-z",
             "the name is kept"},
    RuleText{Rule::name_begins_with_digit, "name-begins-with-digit", warning, "a name begins with a digit",
             "the name is kept"},
    RuleText{Rule::number_too_large, "number-too-large", warning,
             "a limit is beyond the range of double numbers", "the nearest double is taken"},
    RuleText{Rule::not_whole, "not-whole", warning, "the value of an integer attribute is not an integer",
             "the nearest integer is taken"},
    RuleText{Rule::undeclared_node, "undeclared-node", warning, "a node is not listed in BU_",
             "the name is kept, a section about the node is left out"},
    RuleText{Rule::missing_node, "missing-node", warning,
             "a message names no sender, or a signal no receiver", "it has none"},
    RuleText{Rule::duplicate_node, "duplicate-node", warning, "BU_ lists a node twice",
             "the name is one node"},
    RuleText{Rule::missing_extended_flag, "missing-extended-flag", warning,
             "an id of more than 11 bits lacks bit 31, the flag of extended ids",
             "the id is taken for an extended one"},
    RuleText{Rule::impossible_id, "impossible-id", warning, "an id is larger than 29 bits",
             "the message is left out: no frame can have that id"},
    RuleText{Rule::duplicate_id, "duplicate-id", warning, "two messages have the same id",
             "the second one is left out"},
    RuleText{Rule::duplicate_message, "duplicate-message", warning, "two messages have the same name",
             "both are kept, the name refers to the first"},
    RuleText{Rule::message_size, "message-size", warning, "a message has more than 64 bytes",
             "the message is left out: no frame can carry it"},
    RuleText{Rule::fd_format_missing, "fd-format-missing", warning,
             "a message of more than 8 bytes has no VFrameFormat of CAN FD", "it is taken for CAN FD"},
    RuleText{Rule::fd_size, "fd-size", warning, "CAN FD has no frame of the message's size",
             "the size is kept; the frame on the bus is longer"},
    RuleText{Rule::frame_format, "frame-format", warning, "VFrameFormat contradicts the id", "the id counts"},
    RuleText{Rule::cycle_time, "cycle-time", warning, "GenMsgCycleTime is not a time",
             "the message has no cycle time"},
    RuleText{Rule::data_id, "data-id", warning, "E2eDataId is not in 0..65535", "the data id is 0"},
    RuleText{Rule::duplicate_signal, "duplicate-signal", warning,
             "two signals of a message have the same name", "both are kept, the name refers to the first"},
    RuleText{Rule::signal_beyond_message, "signal-beyond-message", warning,
             "a signal reaches beyond its message", "the signal is left out"},
    RuleText{Rule::signal_length, "signal-length", warning, "a signal has no bits, or more than 64",
             "the signal is left out"},
    RuleText{Rule::overlap, "overlap", warning, "two signals of the same frame share bits",
             "both are kept; when encoded, the one with more multiplexors above it overwrites the other; if "
             "both have "
             "as many, the later one overwrites the earlier one"},
    RuleText{Rule::scale_zero, "scale-zero", warning, "a scale is 0", "each raw value means the offset"},
    RuleText{Rule::minimum_above_maximum, "minimum-above-maximum", warning,
             "the minimum of a signal is above its maximum", "the signal has no limits"},
    RuleText{Rule::unreachable_range, "unreachable-range", warning,
             "no raw value lies between a signal's minimum and maximum", "the signal has no limits"},
    RuleText{Rule::float_length, "float-length", warning,
             "SIG_VALTYPE_ and the length of a signal contradict each other",
             "32 bits are a float, 64 bits a double, others an integer"},
    RuleText{Rule::multiplexor_type, "multiplexor-type", warning, "a multiplexor is signed or a float",
             "its bits are compared as an unsigned integer"},
    RuleText{Rule::multiplexor_missing, "multiplexor-missing", warning,
             "a signal is multiplexed in a message without a multiplexor", "the signal is left out"},
    RuleText{Rule::second_multiplexor, "second-multiplexor", warning,
             "a message has two multiplexors, and a signal does not say which one is its own",
             "such signals are left out"},
    RuleText{Rule::multiplexor_value, "multiplexor-value", warning,
             "a multiplexor has too few bits for a value that selects a signal",
             "no frame holds the signal at that value"},
    RuleText{Rule::multiplexing_circle, "multiplexing-circle", warning,
             "multiplexors depend on each other in a circle", "the signals of the circle are left out"},
    RuleText{Rule::multiplexor_left_out, "multiplexor-left-out", warning,
             "the multiplexor of a signal has been left out", "the signal is left out too"},
    RuleText{Rule::indicator_missing, "indicator-missing", warning,
             "SG_MUL_VAL_ names a signal whose SG_ has no indicator M or m<number>", "SG_MUL_VAL_ counts"},
    RuleText{Rule::empty_range, "empty-range", warning, "a range of a multiplexor begins after its end",
             "the range holds no value"},
    RuleText{Rule::duplicate_multiplexing, "duplicate-multiplexing", warning,
             "SG_MUL_VAL_ is given twice for a signal", "the first one counts"},
    RuleText{Rule::unknown_message, "unknown-message", warning, "a section is about an id without a message",
             "the section is left out"},
    RuleText{Rule::unknown_signal, "unknown-signal", warning,
             "a section is about a signal that its message does not have", "the section is left out"},
    RuleText{Rule::unknown_variable, "unknown-variable", warning,
             "a section is about an undefined environment variable", "the section is left out"},
    RuleText{Rule::duplicate_variable, "duplicate-variable", warning,
             "an environment variable is defined twice", "the first one counts"},
    RuleText{Rule::duplicate_table, "duplicate-table", warning, "a value table is defined twice",
             "the first one counts"},
    RuleText{Rule::duplicate_value, "duplicate-value", warning, "a value is named twice",
             "the first name counts"},
    RuleText{Rule::duplicate_values, "duplicate-values", warning, "VAL_ is given twice for a signal",
             "the first one counts"},
    RuleText{Rule::value_beyond_bits, "value-beyond-bits", warning,
             "a signal has too few bits for a named value", "the name is kept"},
    RuleText{Rule::values_of_float, "values-of-float", warning, "the values of a float signal are named",
             "the names are kept"},
    RuleText{Rule::undefined_attribute, "undefined-attribute", warning, "an attribute has no BA_DEF_ above",
             "the section is left out"},
    RuleText{Rule::duplicate_definition, "duplicate-definition", warning, "an attribute is defined twice",
             "the first definition counts"},
    RuleText{Rule::attribute_owner, "attribute-owner", warning,
             "an attribute is given to another kind of object than it is defined for",
             "the section is left out"},
    RuleText{Rule::attribute_limits, "attribute-limits", warning,
             "the minimum of an attribute is above its maximum", "the attribute has no limits"},
    RuleText{Rule::attribute_range, "attribute-range", warning, "a value is outside of its attribute's range",
             "the value is kept"},
    RuleText{Rule::attribute_label, "attribute-label", warning,
             "a value is not in its attribute's enumeration", "the section is left out"},
    RuleText{Rule::duplicate_default, "duplicate-default", warning,
             "the default of an attribute is given twice", "the first one counts"},
    RuleText{Rule::duplicate_attribute, "duplicate-attribute", warning,
             "an attribute is given twice to one object", "the first value counts"},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].rule != Rule{static_cast<std::uint8_t>(i)}) return false;
  }
  return true;
}
static_assert(in_order() && texts.back().rule == Rule::duplicate_attribute);

// Quoted text may contain line ends; a finding is one line.
std::string on_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

}  // namespace

std::span<const RuleText> rule_texts() { return texts; }

const RuleText& text_of(Rule rule) { return texts[static_cast<std::size_t>(rule)]; }

std::string_view name_of(Severity severity) {
  constexpr std::array<std::string_view, 3> names{"note", "warning", "error"};
  return names[static_cast<std::size_t>(severity)];
}

void Findings::add(Rule rule, Position at, std::string what) {
  all_.push_back({rule, at, on_one_line(std::move(what))});
  if (all_.size() < most_findings) return;
  all_.push_back({Rule::too_many_findings, at, "10,000 findings, expected a DBC file"});
  throw Abandoned{};
}

void Findings::add_once(Rule rule, Position at, const std::string& name, std::string what) {
  if (named_.emplace(rule, name).second) add(rule, at, std::move(what));
}

}  // namespace canhil::dbc
