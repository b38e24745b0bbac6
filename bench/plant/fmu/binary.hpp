// The shared library of an FMU, and what the FMU reports.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "bench/plant/fmu/standard.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::plant::fmu {

/// A shared library, loaded until the destructor runs.
class Binary {
 public:
  /// Error, one phrase: it cannot be loaded.
  static Result<Binary> load(const std::string& path);

  /// A function of the library. If the library lacks it, its name is added to `missing`; the result must not
  /// be called then.
  template <class F>
  F* function(const char* name, std::string& missing) const {
    return reinterpret_cast<F*>(symbol(name, missing));
  }

 private:
  [[nodiscard]] void* symbol(const char* name, std::string& missing) const;
  struct Close {
    void operator()(void* handle) const;
  };
  std::unique_ptr<void, Close> handle_;
};

/// What an FMU returns and logs. Its address is the FMU's environment, so it stays where it is.
class Journal {
 public:
  Journal(std::string fmu, bool shown) : fmu_(std::move(fmu)), shown_(shown) {}
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// A message of the FMU.
  void add(int status, const char* category, const char* message);
  /// Whether the status that a function returned is ok or a warning.
  bool accepts(int status);
  /// An error: a function, the status that it returned last, and the last message of the FMU.
  [[nodiscard]] tl::unexpected<Error> failed(std::string_view function) const;
  /// An error: what a function did, and the last message of the FMU.
  [[nodiscard]] tl::unexpected<Error> failed(std::string_view function, std::string_view did) const;
  /// After an error, the FMU may only be freed; after a fatal error, it may not be called at all.
  [[nodiscard]] bool may_terminate() const { return worst_ < standard::error; }
  [[nodiscard]] bool may_free() const { return worst_ != standard::fatal; }

 private:
  std::string fmu_, last_message_;
  bool shown_;
  int last_ = standard::ok, worst_ = standard::ok;
};

}  // namespace canhil::plant::fmu
