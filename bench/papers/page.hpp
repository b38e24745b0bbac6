// The page about the reproduction of a paper, as data, and its output as self-contained HTML and as text.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "bench/papers/figure.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::papers {

struct Table {
  struct Row {
    std::vector<std::string> cells;  ///< one for each column; the last column is the verdict
    std::string mark;                ///< the verdict: yes, no, partly; empty: none
  };
  std::vector<std::string> head;
  std::vector<Row> rows;
  std::string note;
};

struct Section {
  std::string id;  ///< id of the HTML element
  std::string title;
  std::vector<std::variant<std::string, Table, Figure>> parts;  ///< a paragraph is a string
};

struct Page {
  std::string title;
  std::string subtitle;
  std::vector<Section> sections;
};

/// A self-contained HTML file for phone and desktop. Error: a figure cannot be drawn.
Result<std::string> html(const Page& page);

/// Titles and tables, for a terminal.
std::string text(const Page& page);

}  // namespace canhil::papers
