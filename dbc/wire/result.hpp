// A value or an error of one line, for functions with input that may be wrong. Never used on the frame path.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace canhil {

/// One line for the user: what is wrong, where, and what was expected.
struct Error {
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for returning an Error as a Result.
inline tl::unexpected<Error> failure(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace canhil
