// Property: using a plan does not allocate.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <vector>

#include "dbc/parser/parse.hpp"
#include "dbc/parser/plan.hpp"

namespace {
std::atomic<std::size_t> allocations = 0;
}

// Not inlined, because GCC would otherwise report a mismatched free() in these functions.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace canhil::dbc {
namespace {

TEST(Plan, AllocatesNothingWhenUsed) {
  const auto database = read_file(TEST_DATA_DIR "/dbc/multiplexed.dbc");
  ASSERT_TRUE(database) << database.error().message;
  const MessagePlan plan(*find_message(*database, "Extended"));
  std::vector<std::uint8_t> data(plan.size(), 0x11);
  std::vector<double> values(plan.signals());
  const std::size_t before = allocations;
  EXPECT_TRUE(plan.decode(data, values));
  EXPECT_TRUE(plan.encode(values, data));
  EXPECT_TRUE(plan.is_present(0, data));
  EXPECT_EQ(allocations - before, 0U);
  EXPECT_GT(before, 0U);  // the counting works
}

}  // namespace
}  // namespace canhil::dbc
