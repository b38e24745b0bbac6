#include "dbc/spool/spool.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>
#include <vector>

#include "tests/own_folder.hpp"

namespace canhil {
namespace {

static_assert(std::random_access_iterator<Spool<double>::const_iterator>);

struct Sample {
  std::int64_t t_us = 0;
  double value[7] = {};
};
constexpr std::size_t many = 8 * Spool<Sample>::most_in_memory;  // 16 MiB, of which most is in a file

Sample sample(std::size_t index) {
  return {.t_us = static_cast<std::int64_t>(index), .value = {1.0 / static_cast<double>(index + 1)}};
}
bool is_right(const Sample& found, std::size_t index) {
  return found.t_us == sample(index).t_us && found.value[0] == sample(index).value[0];
}

Spool<Sample> filled(std::size_t count) {
  Spool<Sample> spool;
  for (std::size_t index = 0; index < count; ++index) spool.push_back(sample(index));
  return spool;
}

bool holds(const Spool<Sample>& spool, std::size_t count) {
  std::size_t index = 0;
  return spool.size() == count &&
         std::ranges::all_of(spool, [&](const Sample& found) { return is_right(found, index++); });
}

std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t size = 0, resident = 0;
  file >> size >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

class SpoolOf : public testing::TestWithParam<std::size_t> {};

TEST_P(SpoolOf, HoldsWhatWasAdded) {
  const std::size_t count = GetParam();
  const Spool<Sample> spool = filled(count);
  ASSERT_TRUE(holds(spool, count));
  EXPECT_TRUE(is_right(spool.front(), 0));
  EXPECT_TRUE(is_right(spool.back(), count - 1));
  const auto half = static_cast<std::int64_t>(count / 2);
  EXPECT_EQ(std::ranges::lower_bound(spool, half, {}, &Sample::t_us) - spool.begin(), half);
  EXPECT_EQ(spool.rbegin()->t_us, static_cast<std::int64_t>(count) - 1);
}

TEST_P(SpoolOf, IsCopiedAndMoved) {
  const std::size_t count = GetParam();
  Spool<Sample> spool = filled(count);
  Spool<Sample> copy = spool;
  copy.push_back(sample(count));
  EXPECT_TRUE(holds(copy, count + 1));
  EXPECT_TRUE(holds(spool, count));
  const Spool<Sample> moved = std::move(spool);
  EXPECT_TRUE(holds(moved, count));
}

INSTANTIATE_TEST_SUITE_P(Counts, SpoolOf,
                         testing::Values(1, Spool<Sample>::most_in_memory, Spool<Sample>::most_in_memory + 1,
                                         many));

TEST(Spool, WhatIsChangedStays) {
  Spool<Sample> spool = filled(many);
  Sample& first = spool[0];
  for (std::size_t index = 0; index < many; ++index)
    spool[index].value[6] = 6;  // the first pages were released
  first.value[6] = 7;
  EXPECT_TRUE(
      std::all_of(spool.begin() + 1, spool.end(), [](const Sample& one) { return one.value[6] == 6; }));
  EXPECT_EQ(spool[0].value[6], 7);
}

#ifndef CANHIL_SANITIZED  // the sanitizers use memory of their own
TEST(Spool, LetsGoOfWhatItPassed) {
  constexpr std::size_t megabyte = 1 << 20;
  const std::size_t before = resident_bytes();
  Spool<Sample> spool;
  std::size_t most = 0;
  const auto look = [&] { most = std::max(most, resident_bytes() - std::min(before, resident_bytes())); };
  for (std::size_t index = 0; index < 4 * many; ++index) {  // 64 MiB in total
    spool.push_back(sample(index));
    if (index % 10'000 == 0) look();
  }
  std::size_t index = 0;
  for (const Sample& found : spool) {
    ASSERT_TRUE(is_right(found, index));
    if (index++ % 10'000 == 0) look();
  }
  // The spool uses 2 MiB of memory, 1 MiB more while this memory grows, and 2 MiB of the mapped file. The
  // limit leaves room for the heap's own memory.
  EXPECT_LT(most, 10 * megabyte);
}
#endif

TEST(Spool, ManyReadersAtOnce) {
  const Spool<Sample> spool = filled(many);
  std::vector<std::thread> readers;
  std::array<bool, 4> right{};
  for (bool& result : right) readers.emplace_back([&spool, &result] { result = holds(spool, many); });
  for (std::thread& reader : readers) reader.join();
  EXPECT_TRUE(std::ranges::all_of(right, std::identity{}));
}

class SpoolFolder : public testing::Test {
 protected:
  ~SpoolFolder() override { unsetenv("TMPDIR"); }
  static void use(const std::string& folder) { setenv("TMPDIR", folder.c_str(), 1); }
};

TEST_F(SpoolFolder, HasNoNameInIt) {
  const std::string folder = test::own_folder() + "/spool";
  std::filesystem::create_directory(folder);
  use(folder);
  const SpoolFile file;
  EXPECT_TRUE(file.on_disk());
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(SpoolFolder, WithoutOneItIsMemory) {
  use("/nonexistent");
  EXPECT_FALSE(SpoolFile().on_disk());
  EXPECT_TRUE(holds(filled(many), many));
}

// A file size limit simulates a full disk.
TEST_F(SpoolFolder, ThatIsFullInMidwayItIsMemory) {
  signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit few{.rlim_cur = 20 << 20, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &few);
  const Spool<Sample> spool = filled(4 * many);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(holds(spool, 4 * many));
}

}  // namespace
}  // namespace canhil
