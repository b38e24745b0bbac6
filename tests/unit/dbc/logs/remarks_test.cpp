// The remarks of all readers of a program.
#include "dbc/logs/remarks.hpp"

#include "tests/unit/dbc/logs/reading.hpp"

namespace canhil {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string with_comments = "# a\n(1.000000) can0 123#\n# b\n(2.000000) can0 123#\n";

void read_frames(const std::string& name, int count) {
  auto reader = LogReader::of_memory(with_comments, name);
  for (int i = 0; i < count; ++i) ASSERT_TRUE(reader->next());
}

TEST(LogRemarks, AreThoseOfTheReaderThatReadMost) {
  const LogRemarks remarks;
  read_frames("a", 1);
  read_frames("a", 3);
  read_frames("a", 1);
  read_frames("b", 1);
  EXPECT_THAT(remarks.lines(), ElementsAre(HasSubstr("'a': 2 left out: lines that are not frames"),
                                           HasSubstr("'b': 1 left out")));
}

TEST(LogRemarks, AreNotCollectedBeforeAndAfter) {
  read_frames("a", 3);
  {
    const LogRemarks remarks;
    EXPECT_THAT(remarks.lines(), IsEmpty());
  }
  read_frames("a", 3);
}

// The error of such a file has them already.
TEST(LogRemarks, AreNotThoseOfAFileThatIsNoLog) {
  const LogRemarks remarks;
  EXPECT_THAT(test::read_log("a page\nof prose\n").error, HasSubstr("2 left out"));
  EXPECT_THAT(remarks.lines(), IsEmpty());
}

}  // namespace
}  // namespace canhil
