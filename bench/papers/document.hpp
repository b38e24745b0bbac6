// Parses the text of a page after its {{names}} have been filled in:
//
//     # Title of the page
//     Its subtitle, up to a blank line.
//
//     ## id: Title of a section
//
//     A paragraph, up to a blank line.
//
//     | head of a table | verdict |
//     | a row | [partly] in words; [yes], [no] or none |
//     Its note, up to a blank line.
//
//     figure id: Its title
//     x 0 to 20: label
//     y 0.3 to 300, logarithmic: label
//     lines 1 2 3
//     curve label: heading table2 kf_p1
//     Its caption, up to a blank line.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "bench/papers/page.hpp"
#include "bench/papers/template.hpp"

namespace canhil::papers {

/// Maps the first word after the label in a `curve` line to the function that makes the curve. The other
/// words of the line are the arguments of the function.
using Curves = std::map<std::string, std::function<Curve(Words&)>, std::less<>>;

/// Throws std::logic_error if the text does not have the form above. The message of the error is one line
/// that names the wrong place in the text.
Page page_of(std::string_view text, const Curves& curves);

}  // namespace canhil::papers
