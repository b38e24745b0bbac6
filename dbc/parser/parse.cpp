#include "dbc/parser/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dbc/files/text_file.hpp"
#include "dbc/parser/encoding.hpp"
#include "dbc/parser/reader.hpp"

namespace canhil::dbc {
namespace {

void read_version(Reader& in, Draft& draft) { draft.database.version = in.string("the version"); }

// Skips the section NS_. It is a list of names, many of which are keywords, and ends before BS_ or BU_. The
// list does not describe the bus.
void read_new_symbols(Reader& in, Draft& /*draft*/) {
  in.mark(':');
  while (in.peek().kind == TokenKind::word && !in.at_word("BS_") && !in.at_word("BU_")) in.take();
}

// Reads the section BS_ (bit timing), which is obsolete and usually empty.
void read_bit_timing(Reader& in, Draft& /*draft*/) {
  in.mark(':');
  if (in.peek().kind != TokenKind::number) return;
  in.natural("the baud rate", UINT32_MAX);
  if (!in.take_mark_if(':')) return;
  in.natural("BTR1", UINT32_MAX);
  in.mark(',');
  in.natural("BTR2", UINT32_MAX);
}

void read_nodes(Reader& in, Draft& draft) {
  in.mark(':');
  auto& nodes = draft.database.nodes;
  const auto read_node = [&] {
    const Position at = in.peek().at;
    const std::string name = in.word("a node");
    if (draft.nodes.contains(name)) {
      fail_at(Rule::duplicate_node, at,
              fmt::format("node '{}' a second time, expected every node once", name));
    }
    if (name == nobody) return;
    draft.nodes.emplace(name, nodes.size());
    nodes.push_back({.name = name, .comment = {}, .attributes = {}, .at = at});
  };
  const auto is_keyword_next = [&] { return in.peek().kind == TokenKind::word && !in.at_name(); };
  while (!in.at_section_end() && !is_keyword_next())
    in.entry(read_node, [&] { return in.at_name() || is_keyword_next(); });
}

struct Section {
  std::string_view keyword;
  void (*read)(Reader&, Draft&);
};

constexpr std::array<Section, 20> sections{{
    {"VERSION", read_version},
    {"NS_", read_new_symbols},
    {"BS_", read_bit_timing},
    {"BU_", read_nodes},
    {"BO_", read_message},
    {"BO_TX_BU_", read_transmitters},
    {"SIG_GROUP_", read_signal_group},
    {"SIG_VALTYPE_", read_signal_type},
    {"SG_MUL_VAL_", read_extended_mux},
    {"VAL_", read_values},
    {"VAL_TABLE_", read_value_table},
    {"EV_", read_variable},
    {"ENVVAR_DATA_", read_variable_data},
    {"CM_", read_comment},
    {"BA_DEF_", [](Reader& in, Draft& draft) { read_definition(in, draft, false); }},
    {"BA_DEF_REL_", [](Reader& in, Draft& draft) { read_definition(in, draft, true); }},
    {"BA_DEF_DEF_", [](Reader& in, Draft& draft) { read_default(in, draft, false); }},
    {"BA_DEF_DEF_REL_", [](Reader& in, Draft& draft) { read_default(in, draft, true); }},
    {"BA_", read_attribute},
    {"BA_REL_", read_relation_attribute},
}};

/// Skips the rest of a section, of which at least one token must have been taken.
void skip_section(Reader& in) {
  while (!in.at_section_end()) in.take();
  in.take_mark_if(';');
}

/// The attribute of a section whose keyword has been taken; nullopt: the section is not about an attribute.
std::optional<std::string> attribute_of_section(const Reader& in, std::string_view keyword) {
  if (!keyword.starts_with("BA_")) return std::nullopt;
  for (const std::size_t ahead : {0U, 1U}) {  // the kind of object may precede the name
    if (in.peek(ahead).kind == TokenKind::string) return in.peek(ahead).text;
  }
  return "";
}

/// Reads the section that begins with the next token. False: the next token begins neither a section nor an
/// SG_. A malformed section costs only itself, so that one typing error does not cost the whole file.
bool read_section(Reader& in, Draft& draft) {
  const Token first = in.peek();
  const auto section = std::ranges::find(sections, first.text, &Section::keyword);
  if (first.kind != TokenKind::word || section == sections.end()) {
    const bool is_signal = first.kind == TokenKind::word && first.text == "SG_";
    in.report(is_signal ? Rule::unreadable_signal : Rule::unknown_section,
              "a section such as BO_, CM_ or BA_");
    in.take();
    skip_section(in);
    return is_signal;
  }
  in.take();
  draft.findings.set_attribute_section(attribute_of_section(in, first.text));
  try {
    section->read(in, draft);
  } catch (const SectionFailure& failure) {
    const bool in_message = section->read == read_message && failure.rule == Rule::unreadable_section;
    draft.findings.add(in_message ? Rule::unreadable_message : failure.rule, failure.at, failure.what);
    skip_section(in);
  }
  draft.findings.set_attribute_section(std::nullopt);
  return true;
}

/// Reads all sections. False: the text is not empty but contains no section of a DBC.
bool read_sections(Reader& in, Draft& draft) {
  bool any = in.peek().kind == TokenKind::end;
  while (in.peek().kind != TokenKind::end) any = read_section(in, draft) || any;
  return any;
}

Severity severity_of(const Finding& finding) { return text_of(finding.rule).severity; }

std::string line_of(const Finding& finding, std::string_view file_name) {
  return fmt::format("{}:{}:{}: {}", file_name, finding.at.line, finding.at.column, finding.what);
}

/// Returns the database if all findings are less severe than `refused`. If there are findings that are at
/// least as severe as `refused`, returns an error with the first of them.
Result<Database> database_unless(Inspection inspection, Severity refused, std::string_view file_name) {
  const auto worst = std::ranges::find_if(
      inspection.findings, [refused](const Finding& finding) { return severity_of(finding) >= refused; });
  if (worst != inspection.findings.end()) return failure(line_of(*worst, file_name));
  return std::move(*inspection.database);
}

Result<Database> read_file_unless(const std::string& path, Severity refused,
                                  const std::string& encoding = {}) {
  auto inspection = inspect_file(path, encoding);
  if (!inspection) return tl::unexpected(inspection.error());
  return database_unless(std::move(*inspection), refused, path);
}

struct Reading {
  Inspection inspection;
  bool string_spans_section = false;
};

/// Reads a UTF-8 text. `findings`: those about its encoding.
Reading read(std::string_view text, Findings findings, StringEnd end) {
  Draft draft(findings);
  Tokens tokens = tokens_of(text, findings, end);
  Reader in(std::move(tokens.all), findings);
  if (!read_sections(in, draft)) {  // the text is not a DBC: other findings would not help
    return {{{}, {{Rule::not_a_dbc, {}, "no section of a DBC file, expected one such as BO_"}}}, false};
  }
  finish(draft);
  Reading reading{{std::move(draft.database), findings.take()}, tokens.string_spans_section};
  if (std::ranges::count(reading.inspection.findings, Severity::error, severity_of) > 0)
    reading.inspection.database.reset();
  return reading;
}

/// The number of sections, messages and signals that could not be read.
std::ptrdiff_t unread(const Inspection& inspection) {
  constexpr std::array rules{Rule::unreadable_section, Rule::unreadable_entry, Rule::unreadable_message,
                             Rule::unreadable_signal,  Rule::unknown_section,  Rule::not_a_dbc};
  return std::ranges::count_if(inspection.findings, [&](const Finding& finding) {
    return std::ranges::find(rules, finding.rule) != rules.end();
  });
}

/// Reads a UTF-8 text. If a quote seems to be missing, a second reading ends the strings before the next
/// section; the reading that loses less is taken.
Inspection best_reading(std::string_view text, const Findings& findings) {
  Reading reading = read(text, findings, StringEnd::quote);
  if (!reading.string_spans_section) return std::move(reading.inspection);
  const bool is_unfinished = std::ranges::find(reading.inspection.findings, Rule::unfinished_string,
                                               &Finding::rule) != reading.inspection.findings.end();
  Reading other = read(text, findings, StringEnd::quote_or_section);
  const bool is_better = is_unfinished || unread(other.inspection) < unread(reading.inspection);
  return std::move((is_better ? other : reading).inspection);
}

}  // namespace

Inspection inspect(std::string_view text, const std::string& encoding) {
  Findings findings;
  const std::string utf8 = to_utf8(text, encoding, findings);
  Inspection inspection = best_reading(utf8, findings);
  if (encoding.empty() && !findings.all().empty()) {
    // The encoding is a guess. A backslash before a quote may be an escape, or the second half of a
    // character. The wrong choice moves the ends of all following strings.
    if (const std::string other_text = with_two_byte_characters(text); other_text != text) {
      Findings same;
      Inspection other = best_reading(to_utf8(other_text, encoding, same), findings);
      const auto badness = [](const Inspection& one) { return std::pair(unread(one), one.findings.size()); };
      if (badness(other) < badness(inspection)) inspection = std::move(other);
    }
  }
  if (inspection.database) inspection.database->hash = hash(text);
  return inspection;
}

Result<Inspection> inspect_file(const std::string& path, const std::string& encoding) {
  if (!encoding.empty() && !is_encoding(encoding)) {
    return failure(fmt::format(
        "--encoding '{}': expected the name of an encoding, such as those that 'iconv -l' lists", encoding));
  }
  // The size is limited, because a token needs up to about twenty times the memory of its text.
  const auto text = read_text_file(path, "a DBC file", 16 * mebibyte);
  if (!text) return tl::unexpected(text.error());
  return inspect(*text, encoding);
}

Result<Database> parse(std::string_view text, std::string_view file_name) {
  return database_unless(inspect(text), Severity::warning, file_name);
}

Result<Database> usable(Inspection inspection, std::string_view file_name) {
  return database_unless(std::move(inspection), Severity::error, file_name);
}

Result<Database> parse_leniently(std::string_view text, std::string_view file_name) {
  return usable(inspect(text), file_name);
}

Result<Database> read_file(const std::string& path) { return read_file_unless(path, Severity::warning); }

Result<Database> read_file_leniently(const std::string& path, const std::string& encoding) {
  return read_file_unless(path, Severity::error, encoding);
}

std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 0xCBF2'9CE4'8422'2325U;
  for (const char c : text) {
    if (c == '\r') continue;
    value = (value ^ static_cast<unsigned char>(c)) * 0x100'0000'01B3U;
  }
  return value;
}

}  // namespace canhil::dbc
