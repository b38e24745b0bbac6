// Reads the tokens of a DBC text into a draft of the database. This header is internal to the parser.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dbc/parser/lexer.hpp"

namespace canhil::dbc {

class Reader {
 public:
  Reader(std::vector<Token> tokens, Findings& findings) : tokens_(std::move(tokens)), findings_(findings) {}

  [[nodiscard]] const Token& peek(std::size_t ahead = 0) const {
    return tokens_[std::min(index_ + ahead, tokens_.size() - 1)];
  }
  const Token& take() { return tokens_[index_ + 1 < tokens_.size() ? index_++ : index_]; }
  /// True if the next token is the first token of its line, and is a keyword that can begin a section.
  [[nodiscard]] bool at_section() const;
  /// True if the next token is ';', or if the section ends there without a ';'.
  [[nodiscard]] bool at_section_end() const {
    return at_mark(';') || at_section() || peek().kind == TokenKind::end;
  }
  [[nodiscard]] bool at_mark(char mark) const {
    return peek().kind == TokenKind::mark && peek().text[0] == mark;
  }
  [[nodiscard]] bool at_word(std::string_view word) const {
    return peek().kind == TokenKind::word && peek().text == word;
  }
  /// True if word() accepts the next token.
  [[nodiscard]] bool at_name() const {
    return at_name_with_digit() || (peek().kind == TokenKind::word && !is_keyword(peek().text));
  }
  bool take_mark_if(char mark);

  void mark(char mark);
  void semicolon();                         ///< reads the end of a section
  std::string word(std::string_view what);  ///< reads a name that is not a keyword
  std::string string(std::string_view what);
  double real(std::string_view what);
  std::int64_t integer(std::string_view what);
  /// Reads a raw value. A number outside of RawNumber becomes the nearest limit of it.
  RawNumber raw_number(std::string_view what);
  std::uint64_t natural(std::string_view what, std::uint64_t maximum);
  /// Works like natural(), but does not reject a number above the maximum: for such a number, adds a finding
  /// and returns maximum + 1.
  std::uint64_t natural_or(Rule rule, std::string_view what, std::uint64_t maximum);
  /// Reads an integer. For a number that is not an integer, adds a finding and returns the rounded number.
  std::int64_t whole(std::string_view what);
  /// Reads a real number. For a number outside the range of double, adds a finding and returns 0 or the
  /// largest double, with the sign of the number.
  double limit(std::string_view what);
  /// Reads the upper end of a range such as "3-5", and returns 5. The lexer reads the "-5" as one number.
  std::uint64_t natural_after_minus(std::string_view what);

  /// Reads an entry of a list with `read`. If the entry is malformed, adds a finding and skips the tokens
  /// before the next one for which `begins` is true, or before the end of the section: a typing error in one
  /// entry does not cost the others.
  template <class Read, class Begins>
  void entry(const Read& read, const Begins& begins) {
    const std::size_t first = index_;
    try {
      return read();
    } catch (const SectionFailure& failure) {
      const bool malformed = failure.rule == Rule::unreadable_section;
      findings_.add(malformed ? Rule::unreadable_entry : failure.rule, failure.at, failure.what);
    }
    if (index_ == first && !at_section_end() && !at_mark(',')) take();
    while (!at_section_end() && !begins()) take();
  }
  /// Throws SectionFailure: the next token is unexpected, and the rest of the section is not read.
  [[noreturn]] void fail(const std::string& expected) const;
  /// Adds a finding that the next token is unexpected. The reading of the section continues.
  void report(Rule rule, const std::string& expected);

 private:
  [[nodiscard]] bool at_name_with_digit() const;

  std::vector<Token> tokens_;
  Findings& findings_;
  std::size_t index_ = 0;
};

/// The DBC's placeholder for a missing node.
inline constexpr std::string_view nobody = "Vector__XXX";

/// Finds the index of a name in a list, which may have tens of thousands of entries.
using Index = std::map<std::string, std::size_t, std::less<>>;

/// A Database while the text is read. Messages and signals that are marked as left out remain in it until
/// finish() removes them, because later sections may refer to them.
struct Draft {
  explicit Draft(Findings& all) : findings(all) {}

  Findings& findings;
  Database database;
  Index nodes, messages, variables, tables;
  std::map<std::uint64_t, std::size_t> messages_by_id;  ///< key: text_id()
  std::vector<Index> signals;                           ///< of each message
  std::vector<bool> left_out;                           ///< of each message
  Index definitions, relation_definitions;
  std::map<std::string, Position, std::less<>> mux_extended;  ///< "id signal" -> position of its SG_MUL_VAL_
};

/// The id of the pseudo message VECTOR__INDEPENDENT_SIG_MSG. No frame carries the signals of this message.
inline constexpr std::uint32_t independent_signals_id = 0xC000'0000;
inline constexpr std::uint32_t extended_flag = 0x8000'0000;
inline constexpr std::uint32_t last_standard_id = 0x7FF;
inline constexpr std::uint32_t last_extended_id = 0x1FFF'FFFF;

/// The id in the notation of a DBC. Some files omit the flag that marks an extended id. Therefore text_id()
/// adds the flag if the id needs more than 11 bits.
constexpr std::uint64_t text_id(std::uint64_t id) {
  return id > last_standard_id && id <= last_extended_id ? id | extended_flag : id;
}

/// Each of these functions returns the object that the text names. If there is no such object, the function
/// throws SectionFailure, which ends the reading of the section.
Message& message_of(Draft& draft, std::uint64_t raw_id, Position at);
Signal& signal_of(Draft& draft, Message& message, std::string_view name, Position at);
Node& node_of(Draft& draft, std::string_view name, Position at);
/// Adds a finding if the section BU_ does not list the node.
void check_node(Draft& draft, const std::string& name, Position at);
EnvironmentVariable& variable_of(Draft& draft, std::string_view name, Position at);

/// Each of these functions reads one section; the keyword of the section has been taken already.
void read_message(Reader& in, Draft& draft);                    // messages.cpp: BO_ and its SG_
void read_transmitters(Reader& in, Draft& draft);               // BO_TX_BU_
void read_signal_group(Reader& in, Draft& draft);               // SIG_GROUP_
void read_signal_type(Reader& in, Draft& draft);                // SIG_VALTYPE_
void read_extended_mux(Reader& in, Draft& draft);               // SG_MUL_VAL_
void read_values(Reader& in, Draft& draft);                     // annotations.cpp: VAL_
void read_value_table(Reader& in, Draft& draft);                // VAL_TABLE_
void read_variable(Reader& in, Draft& draft);                   // EV_
void read_variable_data(Reader& in, Draft& draft);              // ENVVAR_DATA_
void read_comment(Reader& in, Draft& draft);                    // CM_
void read_definition(Reader& in, Draft& draft, bool relation);  // attributes.cpp: BA_DEF_, BA_DEF_REL_
void read_default(Reader& in, Draft& draft, bool relation);     // BA_DEF_DEF_, BA_DEF_DEF_REL_
void read_attribute(Reader& in, Draft& draft);                  // BA_
void read_relation_attribute(Reader& in, Draft& draft);         // BA_REL_

/// Copies attribute values into messages and signals, and does the checks that are possible only after the
/// whole text has been read. Defined in check.cpp.
void finish(Draft& draft);

}  // namespace canhil::dbc
