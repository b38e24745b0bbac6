// Tests the code that reads the text of a page, and how it reports errors in the text.
#include "bench/papers/document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace canhil::papers {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const Curves curves{{"line", [](Words& words) {
                       words.next();
                       return Curve{.points = {{0, 1}, {1, 2}}};
                     }}};

Page read(const std::string& parts) { return page_of("# Title\nsub\ntitle\n\n" + parts, curves); }

template <class Part>
Part only(const std::string& part) {
  return std::get<Part>(read("## id: Section\n\n" + part).sections.at(0).parts.at(0));
}

std::string complaint(const std::string& part) {
  try {
    read("## id: Section\n\n" + part);
    return "no error";
  } catch (const std::logic_error& error) {
    return error.what();
  }
}

TEST(Document, HasATitleAndSections) {
  const Page page = read("\n## a: First: one\n\nsome\n  words\n\n\n## b: Second\n");
  EXPECT_EQ(page.title, "Title");
  EXPECT_EQ(page.subtitle, "sub title");
  ASSERT_EQ(page.sections.size(), 2U);
  EXPECT_EQ(page.sections[0].id, "a");
  EXPECT_EQ(page.sections[0].title, "First: one");
  ASSERT_EQ(page.sections[0].parts.size(), 1U);
  EXPECT_EQ(std::get<std::string>(page.sections[0].parts[0]), "some words");
  EXPECT_TRUE(page.sections[1].parts.empty());
}

TEST(Document, HasTablesWithVerdictsAndANote) {
  const auto table = only<Table>("| a | b | verdict |\n| 1 | | [partly] so so |\n| 2 | 3 | |\nthe\nnote");
  EXPECT_THAT(table.head, ElementsAre("a", "b", "verdict"));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_THAT(table.rows[0].cells, ElementsAre("1", "", "so so"));
  EXPECT_EQ(table.rows[0].mark, "partly");
  EXPECT_THAT(table.rows[1].cells, ElementsAre("2", "3", ""));
  EXPECT_EQ(table.rows[1].mark, "");
  EXPECT_EQ(table.note, "the note");
}

TEST(Document, HasFigures) {
  const auto figure = only<Figure>(
      "figure fig1: Title: one\nx -5.5 to 0: time [s]\ny 0.3 to 300, logarithmic: error\nlines 1 3\n"
      "curve EKF: line a\ncurve H2, ±5°: line b\nThe\ncaption");
  EXPECT_EQ(figure.id, "fig1");
  EXPECT_EQ(figure.title, "Title: one");
  EXPECT_EQ(figure.x_range, std::pair(-5.5, 0.0));
  EXPECT_EQ(figure.y_range, std::pair(0.3, 300.0));
  EXPECT_EQ(figure.x_label, "time [s]");
  EXPECT_EQ(figure.y_label, "error");
  EXPECT_TRUE(figure.logarithmic);
  EXPECT_THAT(figure.thresholds, ElementsAre(1, 3));
  ASSERT_EQ(figure.curves.size(), 2U);
  EXPECT_EQ(figure.curves[1].label, "H2, ±5°");
  EXPECT_EQ(figure.curves[1].points.size(), 2U);
  EXPECT_EQ(figure.caption, "The caption");
}

TEST(Document, NamesWhatIsWrong) {
  EXPECT_EQ(complaint("| a | b |\n| 1 |"), "page: '| 1 |': expected 2 cells");
  EXPECT_EQ(complaint("| a | b |\n| 1 | 2"), "page: '| 1 | 2': expected '|' at the end of a row");
  EXPECT_THAT(complaint("| a | b |\n| 1 | [maybe] 2 |"), HasSubstr("expected [yes], [no] or [partly]"));
  EXPECT_THAT(complaint("## no title"), HasSubstr("expected ': '"));
  const std::string axes = "x 0 to 1: time\ny 0 to 1: error\n";
  EXPECT_EQ(complaint("figure f: A\n" + axes + "words"),
            "page: 'A': expected lines of x, y and curves, and a caption");
  EXPECT_THAT(complaint("figure f: A\n" + axes + "curve a: line a"), HasSubstr("a caption"));
  EXPECT_THAT(complaint("figure f: A\nx 0 to 1: time\ncurve a: line a\nwords"), HasSubstr("lines of x, y"));
  EXPECT_EQ(complaint("figure f: A\nx 0 to one: time"), "page: 'one': expected a number");
  EXPECT_EQ(complaint("figure f: A\ncurve a: lime a"), "page: curve 'lime a': is unknown");
  EXPECT_EQ(complaint("figure f: A\ncurve a: line"), "page: curve 'line': has too few words");
  EXPECT_EQ(complaint("figure f: A\ncurve a: line a b"), "page: curve 'line a b': has too many words");
}

}  // namespace
}  // namespace canhil::papers
