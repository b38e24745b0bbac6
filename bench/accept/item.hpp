// The result of a test that is no check.
#pragma once

#include <string>

#include "bench/accept/accept.hpp"

namespace canhil::accept {

/// `wrong`: text of the violation; empty if there is no violation.
inline Item item(const std::string& requirement, const std::string& name, const std::string& wrong,
                 const std::string& expected) {
  return {.name = name,
          .kind = "accept",
          .requirement = requirement,
          .outcome = wrong.empty() ? checks::Outcome::pass : checks::Outcome::fail,
          .measured = wrong.empty() ? "as expected" : wrong,
          .expected = expected};
}

}  // namespace canhil::accept
