// The local socket through which a program of the same user takes part in a run.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "bench/processes/program_lines.hpp"
#include "dbc/ports/descriptor.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::partners {

class ControlSocket {
 public:
  /// Listens on a path that must be free. Other users cannot connect. The destructor removes the path. Error,
  /// one line: the reason of the kernel.
  static Result<std::unique_ptr<ControlSocket>> listen(const std::string& path);
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;
  ~ControlSocket();

  /// A client that waits to be served; null: there is none within `patience`.
  std::unique_ptr<processes::ProgramLines> accept(std::chrono::milliseconds patience);
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  ControlSocket(std::string path, Descriptor listener)
      : path_(std::move(path)), listener_(std::move(listener)) {}

  std::string path_;
  Descriptor listener_;
};

}  // namespace canhil::partners
