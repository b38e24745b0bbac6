// The files of the page, built in.
#pragma once

#include "bench/report/embedded_file.hpp"

namespace canhil::live {

extern const report::EmbeddedFiles page_files;

namespace library {
extern const report::EmbeddedFiles chart_files;  ///< Chart.js
}

}  // namespace canhil::live
