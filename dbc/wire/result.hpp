// A value or an error of one line, for functions whose input may be wrong. Functions that are called for each
// frame do not use it.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace canhil {

/// One line for the user that states what is wrong, where, and what was expected.
struct Error {
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

/// A short way to return an Error from a function that returns a Result.
inline tl::unexpected<Error> failure(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace canhil
