// Tests the code that reads traces of PEAK (TRC).
#include "tests/fuzz/whole_log.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  canhil::fuzz::read_with(data, size, canhil::logs::trc_source);
  return 0;
}
