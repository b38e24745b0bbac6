// A Result contains a value or an error of one line. Functions whose input may be wrong return a Result; but
// functions that are called for each frame do not.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace canhil {

/// One line for the user that states what is wrong, where, and what was expected.
struct Error {
  std::string message;
  std::vector<std::string> more{};  ///< further lines of this kind about the same file
};

template <class T>
using Result = tl::expected<T, Error>;

/// A short way to return an Error from a function that returns a Result.
inline tl::unexpected<Error> failure(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace canhil
