// Reads the keys of a [[metric]] table that depend on its kind.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/campaign/metric.hpp"

namespace canhil::campaign {

/// Properties of the campaign that the rules of metrics need.
struct MetricContext {
  const std::vector<std::string>& variants;
  std::int64_t duration_us;  ///< the shortest of the variants
};

/// Reads the rule of a metric of the kind `wanted`; problems are reported to the section.
decltype(Metric::rule) read_metric_rule(scenario::Section& section, const std::string& wanted,
                                        const MetricContext& context);

}  // namespace canhil::campaign
