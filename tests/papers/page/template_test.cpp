// Tests that an error in a template is reported together with its place in the template, and that a page with
// an error is never printed.
#include "bench/papers/template.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

namespace canhil::papers {
namespace {

const Names names{{"runs", [](Words&) { return "300"; }},
                  {"sum",
                   [](Words& words) {
                     const std::string first(words.next());
                     return first + "+" + std::string(words.next());
                   }},
                  {"all", [](Words& words) { return std::string(words.rest()); }},
                  {"few", [](Words&) { return true; }},
                  {"none", [](Words&) { return false; }},
                  {"empty", [](Words&) { return ""; }}};

std::string filled(std::string_view page) {
  const std::array files{EmbeddedFile{"page", page}, EmbeddedFile{"note", "of {{runs}}\n"},
                         EmbeddedFile{"torn", "{{runs"}};
  return papers::filled(files, names);
}

std::string complaint(std::string_view page) {
  try {
    return "no error: " + filled(page);
  } catch (const std::logic_error& error) {
    return error.what();
  }
}

TEST(Template, IsFilledWithFiguresByTheirNames) {
  EXPECT_EQ(filled("{{runs}} runs, {{sum 1 2}}, {{all a b=1 c}}"), "300 runs, 1+2, a b=1 c");
  EXPECT_EQ(filled("<{{>note}}>"), "<of 300>") << "another file, without the end of its last line";
  EXPECT_EQ(filled("a{{#few}} b{{/few}}{{^few}} c{{/few}}"), "a b");
  EXPECT_EQ(filled("a{{#none}} {{unheard_of}}{{/none}}{{^none}} c{{/none}}"), "a c");
}

TEST(Template, EscapesNothing) {
  const Names own{{"tag", [](Words&) { return "a < b & \"c\""; }}};
  const std::array files{EmbeddedFile{"page", "{{tag}}"}};
  EXPECT_EQ(papers::filled(files, own), "a < b & \"c\"");
}

TEST(Template, NamesTheTagThatIsWrong) {
  EXPECT_EQ(complaint("{{rums}}"), "template: {{rums}}: is unknown");
  EXPECT_EQ(complaint("{{#rums}}a{{/rums}}"), "template: {{rums}}: is unknown");
  EXPECT_EQ(complaint("{{runs 3}}"), "template: {{runs 3}}: has too many words");
  EXPECT_EQ(complaint("{{sum 3}}"), "template: {{sum 3}}: has too few words");
  EXPECT_EQ(complaint("{{}}"), "template: {{}}: has too few words");
  EXPECT_EQ(complaint("{{empty}}"), "template: {{empty}}: is empty");
  EXPECT_EQ(complaint("{{few}}"), "template: {{few}}: is yes or no, expected text");
  EXPECT_EQ(complaint("{{#none}}a{{/none}}{{none}}"), "template: {{none}}: is yes or no, expected text");
  EXPECT_EQ(complaint("{{#runs}}a{{/runs}}"), "template: {{runs}}: is text, expected yes or no");
  EXPECT_EQ(complaint("{{>nowhere}}"), "template: no file 'nowhere'");
  EXPECT_EQ(complaint("{{ runs }}"), "template: 'page': expected no blank behind {{");
}

TEST(Template, ReportsWhatMustacheSaysOfBrokenTags) {
  EXPECT_THAT(complaint("{{runs"), testing::StartsWith("template: Unclosed tag"));
  EXPECT_THAT(complaint("{{#few}}a"), testing::StartsWith("template: Unclosed section"));
  EXPECT_THAT(complaint("{{>torn}}"), testing::StartsWith("template: Unclosed tag"));
}

}  // namespace
}  // namespace canhil::papers
