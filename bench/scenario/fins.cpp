#include "bench/scenario/fins.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

Fins read_fins(Section& section) {
  Fins node;
  node.schedule = read_glide_schedule(section);
  node.stamp_error_us = section.time_us("time_stamp_error_ms", Limits::between(-200, 200), 0);
  node.loss = read_sample_loss(section);
  section.finish();
  return node;
}

}  // namespace canhil::scenario
