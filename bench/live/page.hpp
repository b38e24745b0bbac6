// The files of the page, compiled into the program.
#pragma once

#include "bench/report/embedded_file.hpp"

namespace canhil::live {

extern const report::EmbeddedFiles page_texts;

namespace library {
extern const report::EmbeddedFiles chart_texts;  ///< Chart.js
}

}  // namespace canhil::live
