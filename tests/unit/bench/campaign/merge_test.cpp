// The bytes of a merged file depend only on the results in it, not on how the runs were divided or ordered.
#include "bench/campaign/merge.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "bench/campaign/store.hpp"
#include "tests/unit/bench/campaign/runs.hpp"

namespace canhil::campaign {
namespace {

using testing::HasSubstr;
using Files = std::vector<std::filesystem::path>;

Finished finished(const Key& key, double error = 1e-3) {
  // The series is as long as in a real run, so that its row needs overflow pages.
  return {.variant = key.variant,
          .series = run_with(key.run, std::vector<double>(199, error * static_cast<double>(key.run + 1)))};
}

std::filesystem::path shard(
    const std::string& name, const std::vector<Key>& keys, double error = 1e-3,
    const std::function<void(Identity&)>& alter = [](Identity&) {}) {
  static const Campaign campaign = *parse(two_variants);
  auto file = scratch(name);
  Identity identity = identity_of(campaign);
  alter(identity);
  auto store = Store::create(file, identity, campaign.sources);
  for (const Key& key : keys) EXPECT_TRUE(store->add(std::vector{finished(key, error)}));
  store->close();
  return file;
}

const std::vector<Key> all_keys{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 1}, {1, 2}, {1, 3}};

TEST(Merge, GivesTheSameBytesForAnyDivisionAndOrder) {
  std::vector<Key> backwards(all_keys.rbegin(), all_keys.rend());
  const auto whole = shard("whole.sqlite", all_keys), reversed = shard("reversed.sqlite", backwards);
  const auto even = shard("even.sqlite", {{1, 2}, {0, 0}, {1, 0}, {0, 2}});
  const auto odd = shard("odd.sqlite", {{0, 3}, {0, 1}, {1, 1}, {1, 3}});
  const auto a = scratch("a.sqlite"), b = scratch("b.sqlite");
  ASSERT_TRUE(merge(a, Files{whole}));
  for (const Files& files :
       {Files{reversed}, Files{even, odd}, Files{odd, even}, Files{even, whole, odd}, Files{a}}) {
    const auto merged = merge(b, files);
    ASSERT_TRUE(merged) << merged.error().message;
    EXPECT_EQ(content(b), content(a));
  }
  ASSERT_TRUE(merge(a, Files{a, even}));  // the output is also one of the inputs
  EXPECT_EQ(content(a), content(b));
  EXPECT_EQ(Store::open(a)->load(1)->at(2).samples.value(0, quantities::attitude_heading), 3e-3);
}

void expect_refused(const Files& files, const std::string& why) {
  const auto out = shard("earlier.sqlite", all_keys);
  const std::string before = content(out);
  const auto merged = merge(out, files);
  ASSERT_FALSE(merged) << why;
  EXPECT_THAT(merged.error().message, HasSubstr(why));
  EXPECT_EQ(merged.error().message.find('\n'), std::string::npos);
  EXPECT_EQ(content(out), before);
  for (const auto& entry : std::filesystem::directory_iterator(out.parent_path()))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST(Merge, RefusesWhatDoesNotBelongTogether) {
  const auto even = shard("even.sqlite", {{0, 0}, {0, 2}, {1, 0}, {1, 2}});
  const std::vector<Key> odd{{0, 1}, {0, 3}, {1, 1}, {1, 3}};
  const auto altered = [&](const std::function<void(Identity&)>& alter) {
    return Files{even, shard("odd.sqlite", odd, 1e-3, alter)};
  };
  expect_refused(altered([](Identity& id) { ++id.campaign_hash; }), "odd.sqlite: is of another campaign");
  expect_refused(altered([](Identity& id) { ++id.dbc_hash; }), "odd.sqlite: is of another DBC");
  expect_refused(altered([](Identity& id) { id.program += "x"; }), "odd.sqlite: is of another program");
  expect_refused(altered([](Identity& id) { ++id.runs; }), "odd.sqlite: is of a campaign of 5 runs");
  expect_refused({even}, "4 of 8 runs are in no shard (first: run 1 of variant 'A')");
  expect_refused({even, shard("all.sqlite", all_keys, 2e-3)}, "run 0 of variant 0 differs from that in");
  expect_refused({even, scratch("absent.sqlite")},
                 "absent.sqlite: cannot be read (No such file or directory)");
  expect_refused({even, even}, "even.sqlite: is given twice, expected each shard once");
  const auto link = scratch("link.sqlite");
  std::filesystem::create_symlink(even, link);
  expect_refused({even, link}, "link.sqlite: is given twice");
  const auto text = scratch("text.sqlite");
  std::ofstream(text) << std::string(5000, 'x');
  expect_refused({text}, "text.sqlite: is not an SQLite file");
  const auto empty = scratch("empty.sqlite");
  std::ofstream(empty).close();
  expect_refused({empty}, "empty.sqlite: is another kind of file");
}

TEST(Merge, DoesNotReplaceResultsOfAnotherCampaign) {
  const auto whole = shard("whole.sqlite", all_keys);
  const auto out = shard("theirs.sqlite", all_keys, 1e-3, [](Identity& id) { ++id.campaign_hash; });
  const std::string before = content(out);
  EXPECT_THAT(merge(out, Files{whole}).error().message, HasSubstr("theirs.sqlite: is of another campaign"));
  EXPECT_EQ(content(out), before);
  EXPECT_THAT(merge("/proc/none/x.sqlite", Files{whole}).error().message, HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace canhil::campaign
