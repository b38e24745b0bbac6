// Tests the code that reads a file with the results of a campaign. There are two kinds of input. The first is
// a list of changes to the bytes of a valid file: the changed file must give the original report or be
// rejected with an error message. The second is runs with arbitrary samples: the store must accept them, and
// reading them must give a report or an error message.
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>

#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/shards.hpp"
#include "bench/campaign/store.hpp"
#include "bench/campaign_report/report.hpp"
#include "bench/estimators/registry.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/fuzz/short_scenario.hpp"

namespace {

using namespace canhil;
namespace fs = std::filesystem;

constexpr std::uint64_t runs = 2;

// The campaign file. It has metrics of four kinds. All of them are computed from the runs with arbitrary
// samples.
constexpr std::string_view asked = R"(title = "Two"
runs = 2
seed = 3
[[variant]]
name = "A"
scenario = "s.toml"
[[variant]]
name = "B"
scenario = "s.toml"
set = { "target.algorithm" = "robust_h2" }
[[metric]]
kind = "rms_curve"
quantity = "attitude.heading"
[[metric]]
kind = "divergence"
quantity = "attitude.heading"
beyond_mrad = 5
at_most = 0
[[metric]]
kind = "paired"
quantity = "attitude.heading"
at_s = 0.1
other = "B"
at_least = 0.6
[[metric]]
kind = "consistency"
quantity = "innovation.nis"
mean_between = [2.6, 3.4]
)";
// A temporary folder for this process, in memory if possible.
class Folder {
 public:
  Folder() { fs::create_directories(path_); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] fs::path file(const char* name) const { return path_ / name; }

 private:
  fs::path path_ = (fs::exists("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) /
                   ("canhil-fuzz-" + std::to_string(::getpid()));
};

quantities::Samples samples_of(const quantities::Layout& layout, double value) {
  quantities::Samples samples(layout);
  const std::vector<double> values(layout.kept.size(), value);
  for (std::int64_t i = 1; i <= 10; ++i) samples.add(20'000 * i, values);
  return samples;
}

// The output of `hil-bench campaign report`.
Result<std::string> report_on(const fs::path& file) {
  const auto store = campaign::Store::open(file);
  if (!store) return tl::unexpected(store.error());
  if (const auto keys = store->keys(); !keys) return tl::unexpected(keys.error());
  const auto campaign = campaign::campaign_of(*store);
  if (!campaign) return tl::unexpected(campaign.error());
  return campaign::evaluate(*campaign, *store).map([&](const campaign::Evaluation& evaluation) {
    return campaign::text({.campaign = *campaign, .evaluation = evaluation}) +
           campaign::json({.campaign = *campaign, .evaluation = evaluation});
  });
}

struct Sound {
  campaign::Campaign campaign;
  campaign::Identity identity;
  std::string empty, bytes, report;
};

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

Sound make_sound(const fs::path& file) {
  auto campaign = campaign::parse_campaign(asked, "c.toml", [](const std::string&) -> Result<std::string> {
    return std::string(fuzz::short_scenario);
  });
  fuzz::expect(campaign.has_value());
  Sound sound{.campaign = *campaign,
              .identity = campaign::identity_of(*campaign),
              .empty = {},
              .bytes = {},
              .report = {}};
  campaign::Store::create(file, sound.identity, campaign->sources)->close();
  sound.empty = content(file);
  auto store = campaign::Store::resume(file, sound.identity, campaign->sources);
  const auto& layout = estimators::find("transfer_alignment")->layout;
  for (std::size_t variant = 0; variant < 2; ++variant) {
    for (std::uint64_t run = 0; run < runs; ++run) {
      const campaign::Finished finished{
          variant,
          {.run = run, .ending = {}, .samples = samples_of(layout, 1e-3 * static_cast<double>(run + 1))}};
      fuzz::expect(store->add({&finished, 1}).has_value());
    }
  }
  store->close();
  sound.bytes = content(file);
  sound.report = *report_on(file);
  return sound;
}

// Flips bits of the file. For each change, the input contains two bytes for the position, one byte for the
// length, and then the bits to flip.
void damage(const fs::path& file, const Sound& sound, std::span<const std::uint8_t> script) {
  std::string bytes = sound.bytes;
  while (script.size() >= 4) {
    const std::size_t place = (script[0] * 256U + script[1]) % bytes.size();
    const std::size_t length =
        std::min<std::size_t>({1U + script[2] % 16U, script.size() - 3, bytes.size() - place});
    for (std::size_t i = 0; i < length; ++i)
      bytes[place + i] = static_cast<char>(bytes[place + i] ^ script[3 + i]);
    script = script.subspan(3 + length);
  }
  write(file, bytes);
  const auto report = report_on(file);
  if (!report) return fuzz::expect_words(report.error().message);
  fuzz::expect(*report == sound.report);
}

// Stores four runs. For each run, the input contains the outcome, the number of samples, and the values of
// the samples. One byte of the input is enough to select NaN or infinity.
void fill(const fs::path& file, const Sound& sound, std::span<const std::uint8_t> script) {
  const auto byte = [&]() -> std::uint8_t {
    if (script.empty()) return 0;
    const std::uint8_t first = script.front();
    script = script.subspan(1);
    return first;
  };
  const auto number = [&]() -> double {
    constexpr std::array special{0.0,
                                 -0.0,
                                 1e308,
                                 -1e308,
                                 1e-308,
                                 std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity()};
    const std::uint8_t what = byte();
    return what < special.size() ? special[what] : (what - 128.0) * std::pow(2.0, byte() - 128.0);
  };
  write(file, sound.empty);
  auto store = campaign::Store::resume(file, sound.identity, sound.campaign.sources);
  fuzz::expect(store.has_value());
  std::vector<campaign::Finished> all;
  for (std::size_t variant = 0; variant < 2; ++variant) {
    for (std::uint64_t run = 0; run < runs; ++run) {
      const std::uint8_t how = byte();
      const auto estimators = estimators::all();
      const auto& estimator =
          how < 240 ? *estimators::find("transfer_alignment") : *estimators[how % estimators.size()];
      drive::Ending ending{.kind = drive::Ending::Kind::completed, .t_us = 200'000, .detail = ""};
      if (how % 8 == 7)
        ending = {static_cast<drive::Ending::Kind>(byte() % (static_cast<int>(drive::Ending::last_kind) + 1)),
                  byte() * std::int64_t{10'000}, std::string(1, static_cast<char>(byte()))};
      quantities::Samples samples(estimator.layout);
      std::vector<double> values(estimator.layout.kept.size());
      std::int64_t t_us = 0;
      for (int left = byte() % 32; left > 0 && !script.empty(); --left) {
        t_us += byte() * std::int64_t{1'000} + 1;
        for (double& value : values) value = number();
        samples.add(t_us, values);
      }
      all.push_back({variant, {.run = run, .ending = std::move(ending), .samples = std::move(samples)}});
    }
  }
  fuzz::expect(store->add(all).has_value());
  store->close();
  const auto report = report_on(file);
  if (!report) fuzz::expect_words(report.error().message);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  static const fs::path file = folder.file("results.sqlite");
  static const Sound sound = make_sound(file);
  if (size == 0) return 0;
  const std::span<const std::uint8_t> script(data + 1, size - 1);
  if (data[0] < 0x80) {
    damage(file, sound, script);
  } else {
    fill(file, sound, script);
  }
  return 0;
}
