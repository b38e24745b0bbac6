#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "bench/report/page.hpp"
#include "bench/report/run_reports.hpp"
#include "bench/report/whole.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;

// Limits of a report. They bound the memory, which is up to about 100 bytes for each value, and the time: the
// library looks for a key of an object by comparing it with all keys before it. A report of a run has depth
// 6, at most a few hundred keys in an object, and about 100,000 values for each estimator.
constexpr std::size_t most_depth = 32, most_keys = 1000, most_values = 1'000'000;

// Follows the parser without storing a value, and stops it at the first limit that the text exceeds.
class WithinLimits final : public nlohmann::json_sax<Json> {
 public:
  [[nodiscard]] const std::string& what() const { return what_; }

  bool null() override { return value(); }
  bool boolean(bool /*value*/) override { return value(); }
  bool number_integer(number_integer_t /*value*/) override { return value(); }
  bool number_unsigned(number_unsigned_t /*value*/) override { return value(); }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return value(); }
  bool string(string_t& /*value*/) override { return value(); }
  bool binary(binary_t& /*value*/) override { return value(); }
  bool start_object(std::size_t /*size*/) override { return open(); }
  bool start_array(std::size_t /*size*/) override { return open(); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& /*key*/) override {
    if (++keys_.back() <= most_keys) return true;
    return stop(fmt::format("an object has more than {} keys", most_keys));
  }
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                   const nlohmann::detail::exception& /*error*/) override {
    return false;
  }

 private:
  bool value() {
    if (++values_ <= most_values) return true;
    return stop(fmt::format("it has more than {} values", most_values));
  }
  bool open() {
    keys_.push_back(0);
    if (keys_.size() <= most_depth) return value();
    return stop(fmt::format("values lie {} deep within one another", keys_.size()));
  }
  bool close() {
    keys_.pop_back();
    return true;
  }
  bool stop(std::string what) {
    what_ = std::move(what);
    return false;
  }

  std::string what_;
  std::vector<std::size_t> keys_;  // number of keys of each open object; 0 for an array
  std::size_t values_ = 0;
};

}  // namespace

Result<Json> read_document(const std::string& path) {
  const auto text = read_text_file(path, "a report as JSON", 64 * mebibyte);
  if (!text) return tl::unexpected(text.error());
  WithinLimits limits;
  const bool complete = Json::sax_parse(*text, &limits);
  if (!limits.what().empty())
    return failure(fmt::format("file '{}': {}, expected a report", path, limits.what()));
  // The parser ends at a NUL, even if more text follows.
  if (!complete || text->find('\0') != std::string::npos)
    return failure(fmt::format("file '{}': is not JSON, expected a report of hil-bench run --json", path));
  Json document = Json::parse(*text);
  if (!document.is_object() || !document.contains("schema") || document.at("schema") != schema)
    return failure(
        fmt::format("file '{}': is not a report, expected one with \"schema\": \"{}\"", path, schema));
  if (const std::string why = why_not_whole(document); !why.empty())
    return failure(fmt::format("file '{}': {}", path, why));
  return document;
}

}  // namespace canhil::report
