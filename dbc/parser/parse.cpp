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
  while (in.at_name()) {
    const Position at = in.peek().at;
    const std::string name = in.word("a node");
    if (draft.nodes.contains(name)) {
      draft.findings.add(Rule::duplicate_node, at,
                         fmt::format("node '{}' a second time, expected every node once", name));
      continue;
    }
    if (name == nobody) continue;
    draft.nodes.emplace(name, nodes.size());
    nodes.push_back({.name = name, .comment = {}, .attributes = {}, .at = at});
  }
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

Inspection inspect_in_encoding(std::string_view text, const std::string& encoding) {
  Findings findings;
  Draft draft(findings);
  Reader in(tokens_of(to_utf8(text, encoding, findings), findings), findings);
  if (!read_sections(in, draft))  // the text is not a DBC: other findings would not help
    return {{}, {{Rule::not_a_dbc, {}, "no section of a DBC file, expected one such as BO_"}}};
  finish(draft);
  Inspection inspection{std::nullopt, findings.take()};
  if (std::ranges::count(inspection.findings, Severity::error, severity_of) == 0) {
    draft.database.hash = hash(text);
    inspection.database = std::move(draft.database);
  }
  return inspection;
}

}  // namespace

Inspection inspect(std::string_view text, const std::string& encoding) {
  Inspection inspection = inspect_in_encoding(text, encoding);
  const bool is_utf8 = std::ranges::none_of(inspection.findings, [](const Finding& finding) {
    return finding.rule == Rule::windows_1252 || finding.rule == Rule::text_encoding;
  });
  if (!encoding.empty() || is_utf8) return inspection;
  // A backslash before a quote may be an escape, or the second half of a character. The wrong choice moves
  // the ends of all following strings, which causes many findings.
  const std::string other_text = with_two_byte_characters(text);
  if (other_text == text) return inspection;
  Inspection other = inspect_in_encoding(other_text, encoding);
  if (other.findings.size() >= inspection.findings.size()) return inspection;
  if (other.database) other.database->hash = hash(text);
  return other;
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
