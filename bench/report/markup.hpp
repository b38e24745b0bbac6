// Building blocks of all HTML pages (runs and papers): escaping, tables, figures, the whole page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/report/embedded_file.hpp"

namespace canhil::report {

/// canhil::for_markup.
std::string escaped(std::string_view plain);

using Rows = std::vector<std::vector<std::string>>;

/// Cells are HTML; on a phone each cell shows the name of its column.
std::string table(const std::vector<std::string>& head, const Rows& rows, std::string_view style = "");

/// A drawing (HTML) with its title and note (plain text). `id`: id of the element; empty: no id.
std::string figure(std::string_view title, std::string_view drawing, std::string_view note,
                   std::string_view id = "");

/// A self-contained HTML file; title and body are HTML.
std::string whole_page(std::string_view title, EmbeddedFiles styles, std::string_view body);

}  // namespace canhil::report
