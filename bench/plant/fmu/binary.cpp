#include "bench/plant/fmu/binary.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <cstdio>

#include "dbc/text/escape.hpp"

namespace canhil::plant::fmu {
namespace {

std::string_view status_name(int status) {
  constexpr std::array<std::string_view, 6> names{"ok", "warning", "discard", "error", "fatal", "pending"};
  return status >= 0 && static_cast<std::size_t>(status) < names.size()
             ? names[static_cast<std::size_t>(status)]
             : "an unknown status";
}

}  // namespace

void Binary::Close::operator()(void* handle) const { dlclose(handle); }

Result<Binary> Binary::load(const std::string& path) {
  Binary binary;
  binary.handle_.reset(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL));
  if (binary.handle_) return binary;
  const char* reason = dlerror();
  return failure(
      fmt::format("its binary cannot be loaded ({})", reason == nullptr ? path : one_line(reason)));
}

void* Binary::symbol(const char* name, std::string& missing) const {
  void* found = dlsym(handle_.get(), name);
  if (found == nullptr) missing += (missing.empty() ? "" : ", ") + std::string(name);
  return found;
}

void Journal::add(int status, const char* category, const char* message) {
  constexpr std::size_t longest = 500;
  std::string_view text = message == nullptr ? "" : message;
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
  last_message_ = one_line(text.substr(0, longest));
  if (shown_)
    fmt::print(stderr, "{}: {} [{}] {}\n", fmu_, status_name(status),
               one_line(category == nullptr ? "" : category), last_message_);
}

bool Journal::accepts(int status) {
  last_ = status;
  if (status == standard::ok || status == standard::warning) return true;
  if (worst_ != standard::fatal) worst_ = status == standard::fatal ? standard::fatal : standard::error;
  return false;
}

tl::unexpected<Error> Journal::failed(std::string_view function) const {
  if (last_ == standard::pending) return failed(function, "works asynchronously, which is not supported");
  return failed(function, fmt::format("returned {}", status_name(last_)));
}

tl::unexpected<Error> Journal::failed(std::string_view function, std::string_view did) const {
  std::string message = fmt::format("{} {}", function, did);
  if (!last_message_.empty()) message += fmt::format("; the FMU's last message: {}", last_message_);
  return failure(message);
}

}  // namespace canhil::plant::fmu
