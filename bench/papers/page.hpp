// What a reproduction has to say, as data; as one self-contained HTML page, and as text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/papers/figure.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::papers {

enum class Mark : std::uint8_t { yes, no, partly, none };

struct Row {
  std::vector<std::string> cells;  ///< one less than the head: the last column is the verdict
  Mark mark = Mark::none;
  std::string verdict;
};

struct Table {
  std::vector<std::string> head;
  std::vector<Row> rows;
  std::string note;
};

struct Section {
  std::string id;  ///< of the HTML element
  std::string title;
  std::vector<std::string> paragraphs;
  std::vector<Table> tables;
  std::vector<Figure> figures;
};

struct Page {
  std::string title;
  std::string subtitle;
  std::vector<Section> sections;
};

/// What became of a paper. None has a default: a paper that forgets one does not compile.
struct Reproduction {
  Page page;
  bool bars_met;
  std::uint64_t runs;    ///< flown of each variant of the campaign with the bars
  std::uint64_t enough;  ///< that the bars are for: with fewer they may be missed by chance
};

/// One HTML file without anything outside it, for phone and desktop. Error: a figure cannot be drawn.
Result<std::string> html(const Page& page);

/// Titles, paragraphs and tables for a terminal.
std::string text(const Page& page);

}  // namespace canhil::papers
