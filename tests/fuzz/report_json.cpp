// Tests the code that reads the report of a run. Any JSON must give a page and a comparison, or an error
// message. The input is either the text of a report, or a list of changes (replace, remove, copy, add or
// scale a value) to the report of a run that this program flies at its start. The fuzzer does not change
// single bytes of that report (30 kB), because this would soon give invalid JSON.
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/drive/contract.hpp"
#include "bench/drive/session.hpp"
#include "bench/report/compare.hpp"
#include "bench/report/page.hpp"
#include "bench/report/run_reports.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/fuzz/short_scenario.hpp"

namespace {

using namespace canhil;
using Json = nlohmann::ordered_json;

// Flies a run over a simulated wire, so that the report contains distributions of times. Removes all but two
// messages from each table of times, and all but two series, because reading them takes most of the time.
Json flown() {
  const auto scenario = scenario::parse(fuzz::short_scenario, "short.toml", drive::contract());
  fuzz::expect(scenario.has_value());
  drive::Options options;
  options.bus = drive::BusName("in-process?bitrate=500000");
  const std::atomic<bool> stop = false;
  const auto run = drive::run(*scenario, options, stop, [](std::int64_t) {});
  fuzz::expect(run.has_value());
  Json report = report::document(*scenario, *run);
  constexpr std::size_t most = 2;
  for (const char* key : {"latency_s", "jitter_s", "transmit_lateness_s"}) {
    while (report.at(key).size() > most) report.at(key).erase(std::prev(report.at(key).end()));
  }
  Json& series = report.at("series");
  while (series.size() > most) series.erase(series.begin());
  return report;
}

class Changes {
 public:
  explicit Changes(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  Json applied(const Json& report) {
    Json changed = report;
    while (!rest_.empty()) change(changed);
    return changed;
  }

 private:
  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const std::uint8_t first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }

  // Selects a value of the JSON document: begins at the root, and at each step goes down to one of the
  // members. Sets `above` to the parent of the selected value.
  Json* walk(Json& root, Json*& above, std::size_t& place) {
    Json* at = &root;
    for (int steps = byte() % 8; steps > 0 && at->is_structured() && !at->empty(); --steps) {
      above = at;
      place = byte() % at->size();
      at = &*std::next(at->begin(), static_cast<std::ptrdiff_t>(place));
    }
    return at;
  }

  Json value() {
    switch (const std::uint8_t kind = byte(); kind % 10) {
      case 0:
        return nullptr;
      case 1:
        return kind >= 128;
      case 2:
        return byte();
      case 3:
        return -1.0 - byte();
      case 4:
        return 1e308 * (kind >= 128 ? -1 : 1);
      case 5:
        return std::string(byte(), static_cast<char>(byte()));
      case 6:
        return Json::array();
      case 7:
        return Json::object();
      case 8:
        return ~std::uint64_t{0} >> (byte() % 64);
      default:
        return std::string("<\"'&>\n") + static_cast<char>(byte());
    }
  }

  void change(Json& root) {
    Json* above = nullptr;
    std::size_t place = 0;
    const std::uint8_t how = byte();
    Json* at = walk(root, above, place);
    if (above == nullptr) return;
    switch (how % 5) {
      case 0:
        *at = value();
        break;
      case 1:
        above->erase(std::next(above->begin(), static_cast<std::ptrdiff_t>(place)));
        break;
      case 2: {  // replaces a value by a copy of another value
        Json* other_above = nullptr;
        Json copy = *walk(root, other_above, place);
        if (copy.dump(-1, ' ', true, Json::error_handler_t::replace).size() < 20'000) *at = std::move(copy);
        break;
      }
      case 3:
        if (at->is_array()) at->push_back(value());
        if (at->is_object()) at->emplace(std::string(1, static_cast<char>(byte())), value());
        break;
      case 4:
        if (at->is_number()) *at = at->get<double>() * (byte() - 128.0) / 64.0;
        break;
    }
  }

  std::span<const std::uint8_t> rest_;
};

// Does what `hil-bench report` and `hil-bench compare` do.
void use(const std::string& text, const report::Reports& whole) {
  static const int file = ::memfd_create("report", 0);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  fuzz::expect(::ftruncate(file, 0) == 0);
  fuzz::expect(::pwrite(file, text.data(), text.size(), 0) == static_cast<::ssize_t>(text.size()));
  const auto report = report::read_document(path);
  if (!report) return fuzz::expect_words(report.error().message, "file '");
  if (const auto page = report::html(*report); !page) fuzz::expect_words(page.error().message);
  const report::Reports given{*report};
  for (const auto& [before, after] : {std::pair(&whole, &given), std::pair(&given, &whole)}) {
    const auto compared = report::compare(*before, *after);
    if (!compared) fuzz::expect_words(compared.error().message);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const report::Reports whole{flown()};
  if (size == 0) return 0;
  if (data[0] == '{') {  // the text of a file
    use({reinterpret_cast<const char*>(data), size}, whole);
  } else {
    const Json changed = Changes({data + 1, size - 1}).applied(whole.front());
    use(changed.dump(-1, ' ', true, Json::error_handler_t::replace), whole);
  }
  return 0;
}
