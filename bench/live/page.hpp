// The files of the page, compiled into the program.
#pragma once

#include "dbc/text/embedded_file.hpp"

namespace canhil::live {

extern const EmbeddedFiles page_texts;

namespace library {
extern const EmbeddedFiles chart_texts;  ///< Chart.js
}

}  // namespace canhil::live
