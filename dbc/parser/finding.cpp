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
    RuleText{Rule::unfinished_string, "unfinished-string", warning, "a quoted string has no closing quote",
             "the string ends before the next line that begins a section"},
    RuleText{Rule::unreadable_message, "unreadable-message", warning,
             "the first line of a message (BO_) is malformed", "the message is left out"},
    RuleText{Rule::unreadable_signal, "unreadable-signal", warning,
             "a signal (SG_) is malformed, or does not follow a message", "the signal is left out"},
    RuleText{Rule::too_many_findings, "too-many-findings", warning, "the file has more than 10,000 findings",
             "the other findings are not listed"},
    RuleText{Rule::windows_1252, "windows-1252", note, "the text is not UTF-8", "it is read as Windows-1252"},
    RuleText{Rule::text_encoding, "text-encoding", warning,
             "the text has bytes that are no character of its encoding",
             "each of them is read as U+FFFD; the option --encoding selects the encoding"},
    RuleText{Rule::independent_signals, "independent-signals", note,
             "the message VECTOR__INDEPENDENT_SIG_MSG, id 0xC0000000, contains signals that no frame carries",
             "the message is left out"},
    RuleText{Rule::unreadable_section, "unreadable-section", warning, "a section other than BO_ is malformed",
             "the section is left out"},
    RuleText{Rule::unreadable_entry, "unreadable-entry", warning,
             "an entry of a list in a section is malformed", "the entry is left out"},
    RuleText{Rule::unknown_section, "unknown-section", warning, "a section begins with an unknown word",
             "the section is left out"},
    RuleText{Rule::missing_semicolon, "missing-semicolon", warning, "a section ends without ';'",
             "the section ends where the next one begins"},
    RuleText{Rule::line_comment, "line-comment", warning, "a comment begins with '//'",
             "the text from '//' to the end of the line is ignored"},
    RuleText{Rule::unexpected_character, "unexpected-character", warning,
             "a character that the format does not use",
             "the entry or section that contains the character cannot be read"},
    RuleText{Rule::name_character, "name-character", warning, "a name contains characters that are not ASCII",
             "the name is kept"},
    RuleText{Rule::name_begins_with_digit, "name-begins-with-digit", warning, "a name begins with a digit",
             "the name is kept"},
    RuleText{Rule::number_too_large, "number-too-large", warning,
             "a minimum or maximum is outside the range of double numbers", "the nearest double is used"},
    RuleText{Rule::not_whole, "not-whole", warning, "the value of an integer attribute is not an integer",
             "the nearest integer is used"},
    RuleText{Rule::undeclared_node, "undeclared-node", warning, "a node is not listed in BU_",
             "the name is kept, a section about the node is left out"},
    RuleText{Rule::missing_node, "missing-node", warning,
             "a message names no sender, or a signal names no receiver",
             "the message has no sender, or the signal has no receiver"},
    RuleText{Rule::duplicate_node, "duplicate-node", warning, "BU_ lists a node twice",
             "the second entry is ignored"},
    RuleText{Rule::missing_extended_flag, "missing-extended-flag", warning,
             "an id of more than 11 bits lacks bit 31, the flag of extended ids",
             "the id is read as an extended id"},
    RuleText{Rule::impossible_id, "impossible-id", warning, "an id has more than 29 bits",
             "the message is left out: no frame can have that id"},
    RuleText{Rule::duplicate_id, "duplicate-id", warning, "two messages have the same id",
             "the second one is left out"},
    RuleText{Rule::duplicate_message, "duplicate-message", warning, "two messages have the same name",
             "both are kept; the name refers to the first"},
    RuleText{Rule::message_size, "message-size", warning,
             "a message has more than 64 bytes, and no transport protocol carries it",
             "the message is left out: no frame can carry it"},
    RuleText{Rule::fd_format_missing, "fd-format-missing", warning,
             "a message of more than 8 bytes has no VFrameFormat of CAN FD",
             "the message is read as a CAN FD message"},
    RuleText{Rule::fd_size, "fd-size", warning,
             "CAN FD has no frame size that equals the size of the message",
             "the size is kept; the frame on the bus is longer"},
    RuleText{Rule::frame_format, "frame-format", warning,
             "VFrameFormat and the id disagree on whether the id is extended", "the id decides"},
    RuleText{Rule::cycle_time, "cycle-time", warning, "GenMsgCycleTime is not a possible cycle time",
             "the message is read without a cycle time"},
    RuleText{Rule::data_id, "data-id", warning, "E2eDataId is not in 0..65535", "0 is used as the data id"},
    RuleText{Rule::duplicate_signal, "duplicate-signal", warning,
             "two signals of a message have the same name", "both are kept; the name refers to the first"},
    RuleText{Rule::signal_beyond_message, "signal-beyond-message", warning,
             "a signal reaches beyond its message", "the signal is left out"},
    RuleText{Rule::signal_length, "signal-length", warning, "a signal has no bits, or more than 64",
             "the signal is left out"},
    RuleText{Rule::overlap, "overlap", warning, "two signals of the same frame share bits",
             "both are kept; in encoding, the signal that depends on more multiplexors overwrites the other "
             "one; if both depend on the same number, the signal that comes later in the file overwrites the "
             "earlier one"},
    RuleText{Rule::scale_zero, "scale-zero", warning, "the scale of a signal is 0",
             "the physical value always equals the offset"},
    RuleText{Rule::minimum_above_maximum, "minimum-above-maximum", warning,
             "the minimum of a signal is above its maximum", "the limits are ignored"},
    RuleText{Rule::unreachable_range, "unreachable-range", warning,
             "no raw value of a signal gives a physical value between its minimum and maximum",
             "the limits are ignored"},
    RuleText{
        Rule::float_length, "float-length", warning,
        "SIG_VALTYPE_ and the length of a signal contradict each other",
        "a signal of 32 bits is read as a float, of 64 bits as a double, of any other length as an integer"},
    RuleText{Rule::multiplexor_type, "multiplexor-type", warning, "a multiplexor is signed or a float",
             "for the selection of signals, its bits are read as an unsigned integer"},
    RuleText{Rule::multiplexor_missing, "multiplexor-missing", warning,
             "a signal is multiplexed in a message without a multiplexor", "the signal is left out"},
    RuleText{Rule::second_multiplexor, "second-multiplexor", warning,
             "a message has two multiplexors, and for a multiplexed signal the file does not define which of "
             "them selects it",
             "signals without a defined multiplexor are left out"},
    RuleText{Rule::multiplexor_value, "multiplexor-value", warning,
             "a multiplexor has too few bits for a value that selects a signal",
             "no frame can carry this value of the multiplexor"},
    RuleText{Rule::multiplexing_circle, "multiplexing-circle", warning,
             "multiplexors depend on each other in a circle", "the signals of the circle are left out"},
    RuleText{Rule::multiplexor_left_out, "multiplexor-left-out", warning,
             "the multiplexor of a signal has been left out", "the signal is left out too"},
    RuleText{Rule::indicator_missing, "indicator-missing", warning,
             "SG_MUL_VAL_ names a signal whose SG_ lacks the indicator M or m<number>",
             "the signal is read as SG_MUL_VAL_ defines"},
    RuleText{Rule::empty_range, "empty-range", warning,
             "the first value of a multiplexor range is above the last value", "the range contains no value"},
    RuleText{Rule::duplicate_multiplexing, "duplicate-multiplexing", warning,
             "SG_MUL_VAL_ is given twice for a signal", "the first one is used"},
    RuleText{Rule::unknown_message, "unknown-message", warning,
             "a section refers to an id that no message has", "the section is left out"},
    RuleText{Rule::unknown_signal, "unknown-signal", warning,
             "a section refers to a signal that the message does not have",
             "the section, or the entry of its list, is left out"},
    RuleText{Rule::unknown_variable, "unknown-variable", warning,
             "a section refers to an undefined environment variable", "the section is left out"},
    RuleText{Rule::duplicate_variable, "duplicate-variable", warning,
             "an environment variable is defined twice", "the first definition is used"},
    RuleText{Rule::duplicate_table, "duplicate-table", warning, "a value table is defined twice",
             "the first definition is used"},
    RuleText{Rule::duplicate_value, "duplicate-value", warning, "a value has two names",
             "the first name is used"},
    RuleText{Rule::duplicate_values, "duplicate-values", warning, "VAL_ is given twice for a signal",
             "the first one is used"},
    RuleText{Rule::value_beyond_bits, "value-beyond-bits", warning,
             "a signal has too few bits for a value that has a name", "the name is kept"},
    RuleText{Rule::values_of_float, "values-of-float", warning, "values of a float signal have names",
             "the names are kept"},
    RuleText{Rule::undefined_attribute, "undefined-attribute", warning,
             "an attribute is used, but no BA_DEF_ above it defines it", "the section is left out"},
    RuleText{Rule::duplicate_definition, "duplicate-definition", warning, "an attribute is defined twice",
             "the first definition is used"},
    RuleText{Rule::attribute_owner, "attribute-owner", warning,
             "an attribute is assigned to an object of a kind for which it is not defined",
             "the section is left out"},
    RuleText{Rule::attribute_limits, "attribute-limits", warning,
             "the minimum of an attribute is above its maximum", "the limits are ignored"},
    RuleText{Rule::attribute_range, "attribute-range", warning,
             "the value of an attribute is outside the range of the attribute", "the value is kept"},
    RuleText{Rule::attribute_label, "attribute-label", warning,
             "the value of an attribute is not in the enumeration of the attribute",
             "the section is left out"},
    RuleText{Rule::duplicate_default, "duplicate-default", warning,
             "the default of an attribute is given twice", "the first one is used"},
    RuleText{Rule::duplicate_attribute, "duplicate-attribute", warning,
             "an attribute is assigned twice to the same object", "the first value is used"},
    RuleText{
        Rule::long_symbol, "long-symbol", warning,
        "the long symbol of an object (SystemSignalLongSymbol and the like) is not a name, or is the name "
        "of another object",
        "the short name is used"},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].rule != Rule{static_cast<std::uint8_t>(i)}) return false;
  }
  return true;
}
static_assert(in_order() && texts.back().rule == Rule::long_symbol);

// Replaces control characters by blanks. A finding must be one line, but text that it quotes may contain line
// ends.
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
  if (all_.size() > most_findings) return;
  if (all_.size() == most_findings) {
    rule = Rule::too_many_findings;
    what = "more than 10,000 findings, expected a DBC file";
  }
  all_.push_back({.rule = rule,
                  .at = at,
                  .what = on_one_line(std::move(what)),
                  .attribute = attribute_.value_or(""),
                  .in_attribute_section = attribute_.has_value()});
}

void Findings::add_once(Rule rule, Position at, const std::string& name, std::string what) {
  if (named_.emplace(rule, name).second) add(rule, at, std::move(what));
}

}  // namespace canhil::dbc
