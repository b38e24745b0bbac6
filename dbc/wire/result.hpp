// An outcome or one line of explanation, for input that may be wrong. Never used on the frame path.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace canhil {

/// One line for a person: what, where, what was expected.
struct Error {
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand to leave a function that returns a Result with an explanation.
inline tl::unexpected<Error> failure(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace canhil
