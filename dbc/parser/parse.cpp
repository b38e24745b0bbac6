#include "dbc/parser/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "dbc/files/text_file.hpp"
#include "dbc/parser/reader.hpp"

namespace canhil::dbc {
namespace {

void read_version(Reader& in, Draft& draft) { draft.database.version = in.string("the version"); }

// The new symbols: names, many of them keywords, up to BS_ or BU_. They say nothing about the bus.
void read_new_symbols(Reader& in, Draft& /*draft*/) {
  in.mark(':');
  while (in.peek().kind == TokenKind::word && !in.at_word("BS_") && !in.at_word("BU_")) in.take();
}

// Bit timing: obsolete, mostly empty.
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
  while (in.peek().kind == TokenKind::word && !is_keyword(in.peek().text)) {
    const Token& name = in.take();
    if (draft.nodes.contains(name.text)) {
      throw ParseFailure{name.at,
                         fmt::format("node '{}' a second time, expected every node once", name.text)};
    }
    if (name.text == nobody) continue;
    draft.nodes.emplace(name.text, nodes.size());
    nodes.push_back({name.text, {}, {}});
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

Database parse_or_throw(std::string_view text) {
  Reader in(tokens_of(to_utf8(text)));
  Draft draft;
  while (in.peek().kind != TokenKind::end) {
    const auto section = std::ranges::find(sections, in.peek().text, &Section::keyword);
    if (in.peek().kind != TokenKind::word || section == sections.end())
      in.fail("a section such as BO_, CM_ or BA_");
    in.take();
    section->read(in, draft);
  }
  finish(draft);
  draft.database.hash = hash(text);
  return std::move(draft.database);
}

// Quoted text may hold line ends; a message may not.
std::string on_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

}  // namespace

Result<Database> parse(std::string_view text, std::string_view file_name) {
  try {
    return parse_or_throw(text);
  } catch (const ParseFailure& error) {
    return failure(
        fmt::format("{}:{}:{}: {}", file_name, error.at.line, error.at.column, on_one_line(error.what)));
  }
}

Result<Database> read_file(const std::string& path) {
  // A token takes up to some twenty times the memory of its text.
  const auto text = read_text_file(path, "a DBC file", 16 * mebibyte);
  if (!text) return tl::unexpected(text.error());
  return parse(*text, path);
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
