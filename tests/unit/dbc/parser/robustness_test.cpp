// For any text, parse() returns either a Database that the codec can use, or an error of one line.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "dbc/parser/codec.hpp"
#include "dbc/parser/parse.hpp"

namespace canhil::dbc {
namespace {

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_sound_or_one_line(const Result<Database>& database) {
  if (!database) {
    EXPECT_TRUE(database.error().message.starts_with("x.dbc:"));
    EXPECT_NE(database.error().message.find("expected"), std::string::npos) << database.error().message;
    return;
  }
  for (const Message& message : database->messages) {
    const std::vector<std::uint8_t> data(message.size, 0xFF);
    EXPECT_TRUE(decode(message, data));
    EXPECT_TRUE(encode(message, {}));
  }
}

class Robustness : public testing::TestWithParam<const char*> {};

// Removes and copies pieces of a correct file, and changes single characters.
TEST_P(Robustness, MutatedFilesAreReadOrRefused) {
  const std::string original = content_of(std::string(TEST_DATA_DIR "/dbc/") + GetParam());
  ASSERT_FALSE(original.empty());
  std::mt19937 random(1);
  for (int i = 0; i < 3000 && !HasFailure(); ++i) {
    std::string text = original;
    for (auto changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      const std::size_t length = std::min<std::size_t>(random() % 20, text.size() - at);
      switch (random() % 4) {
        case 0:
          text.erase(at, length);
          break;
        case 1:
          text.insert(at, text.substr(random() % text.size(), length));
          break;
        case 2:
          text[at] = static_cast<char>(random());
          break;
        default:
          text[at] = "0123456789mM|@-+:;\"() "[random() % 22];
          break;
      }
      if (text.empty()) break;
    }
    expect_sound_or_one_line(parse(text, "x.dbc"));
    expect_sound_or_one_line(parse_leniently(text, "x.dbc"));
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Robustness,
                         testing::Values("vector_style.dbc", "multiplexed.dbc", "fd.dbc", "floats.dbc",
                                         "motorola.dbc"));

}  // namespace
}  // namespace canhil::dbc
