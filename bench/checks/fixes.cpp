#include "bench/checks/fixes.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "bench/checks/finding.hpp"
#include "bench/checks/silence.hpp"

namespace canhil::checks {
namespace {

using messages::FixSource;

std::string_view group_of(FixSource source) {
  return source == FixSource::gps ? messages::GpsTime::info.sample_group
                                  : messages::SsblRelativeD::info.sample_group;
}

}  // namespace

std::string unanswered_fixes(const Observations& seen, const scenario::Window& window) {
  std::set<std::pair<FixSource, std::int64_t>> answered;
  for (const FixAnswer& fix : seen.fixes) answered.emplace(fix.source, fix.cause_us);
  std::map<FixSource, int> in_a_row;
  for (const auto& [source, valid_us] : seen.sent_fixes) {
    if (!within(window, valid_us)) continue;
    int& missing = in_a_row[source];
    missing = answered.contains({source, valid_us}) ? 0 : missing + 1;
    if (missing > tolerated_fixes)
      return fmt::format("no answers to {} before {:g} s", group_of(source),
                         static_cast<double>(valid_us) * 1e-6);
  }
  return "";
}

}  // namespace canhil::checks
