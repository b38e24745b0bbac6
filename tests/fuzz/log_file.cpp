// Tests the detection of the format of a log, and the code that reads captures, decompresses logs and
// converts UTF-16.
#include "tests/fuzz/whole_log.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  canhil::fuzz::read_with(data, size, canhil::logs::source_of);
  return 0;
}
