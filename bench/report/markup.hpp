// Building blocks of all HTML pages: escaping, tables, figures, the whole page. A page keeps its meaning
// where a server forbids its style sheet and its script (Content-Security-Policy of a CI server): what
// carries meaning stands in attributes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dbc/text/embedded_file.hpp"

namespace canhil::report {

/// canhil::for_markup.
std::string escaped(std::string_view plain);

/// HTML whose long words may be broken: after at least `few` characters behind punctuation or before a
/// capital, at the latest after 16 characters. The text itself stays the same. The style sheet has
/// other ways and hides the breaks.
std::string breakable(std::string_view html, std::size_t few = 6);

/// HTML in a colour of the palette, and bold: `name` is a class of the style sheet and a colour of the
/// palette.
std::string coloured(std::string_view name, std::string_view html);

using Rows = std::vector<std::vector<std::string>>;

/// Cells are HTML; the only cell of a row is as wide as the table. `style` "figures": numbers, in a box that
/// scrolls if it is too wide; "pairs": names and values. On a phone, the cells of the other tables stand one
/// below another, each with the name of its column.
std::string table(const std::vector<std::string>& head, const Rows& rows, std::string_view style = "");

/// A part of the page that a click opens. Both are HTML.
std::string folded(std::string_view summary, std::string_view content);

/// A drawing (HTML) with its title and note (plain text). `id`: id of the element; empty: no id.
std::string figure(std::string_view title, std::string_view drawing, std::string_view note,
                   std::string_view id = "");

/// A self-contained HTML file; title and body are HTML. `scripts`: what makes the plots interactive; the page
/// shows everything without them.
std::string whole_page(std::string_view title, EmbeddedFiles styles, std::string_view body,
                       EmbeddedFiles scripts = {});

}  // namespace canhil::report
