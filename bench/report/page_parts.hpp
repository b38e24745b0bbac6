// The parts of which the pages of a run, a campaign, a suite are made. A page is
//
//   whole_page(title, styles,
//              head(title, "scenario &middot; bus") + verdict("fail", "2 of 3 runs") + links({{"checks",
//              "checks"}}) +
//                  section("checks", "Checks", judgements({...})) +
//                  section("curves", "Curves", grid(figure("RMS", drawn(LinePlot{...}), "note"))) +
//                  section("provenance", "Provenance", facts(json)),
//              scripts);
//
// `scripts` only if the page has plots. table(), folded(), figure(): markup.hpp; drawn(), svg(): plot.hpp.
// Every part is HTML that keeps its meaning without style sheet and script.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/report/markup.hpp"

namespace canhil::report {

using Json = nlohmann::ordered_json;

/// The style of the pages, and the script that makes their plots interactive, both built into the program.
extern const EmbeddedFiles styles;
extern const EmbeddedFiles scripts;

/// A value of the report as HTML text.
inline std::string text_in(const Json& value) {
  return escaped(value.is_string() ? value.get<std::string>() : value.dump());
}

/// The appearance of an outcome; colour is not the only difference.
struct Look {
  const char* style;
  const char* sign;
};
inline Look look_of(std::string_view outcome) {
  return outcome == "pass"   ? Look{"yes", "&#10003;"}
         : outcome == "fail" ? Look{"no", "&#10007;"}
                             : Look{"unknown", "?"};
}
/// An outcome with its sign and colour. `words` (HTML): what stands in place of the outcome; empty: the
/// outcome.
std::string outcome_words(std::string_view outcome, std::string_view words = "");

/// The heading of a page; `about` is HTML.
std::string head(std::string_view title, std::string_view about);
/// The outcome of everything on the page, with its reason (plain text).
std::string verdict(std::string_view outcome, std::string_view reason);
/// Links to sections: id and title.
std::string links(const std::vector<std::pair<std::string, std::string>>& sections);
/// `content` is HTML.
std::string section(std::string_view id, std::string_view title, std::string_view content);
/// Figures side by side, as many as there is room for.
std::string grid(std::string_view figures);
/// A remark about something that is not known (plain text).
std::string not_known(std::string_view what);

/// A row of a table of judgements.
struct Judged {
  std::string name;  ///< plain text
  std::string outcome;
  std::string measured, expected, requirement;  ///< plain text; the requirement stands behind `expected`
  std::string link{};  ///< id of the element to which the name is a link; empty: none
  std::string more{};  ///< HTML under the row; empty: nothing
};
std::string judgements(const std::vector<Judged>& all);

/// Nested objects as a table of names and values, with rows such as "target: program".
std::string facts(const Json& object);

}  // namespace canhil::report
