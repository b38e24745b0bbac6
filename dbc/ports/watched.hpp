// A set of descriptors that has a descriptor of its own: it is readable while one of them has a watched
// event.
#pragma once

#include <sys/epoll.h>

#include <cstdint>

#include "dbc/ports/descriptor.hpp"

namespace canhil {

/// An epoll set.
class Watched {
 public:
  Watched() : epoll_(::epoll_create1(EPOLL_CLOEXEC)) {}

  /// Watches these events of the descriptor from now on; 0: none.
  void watch(int descriptor, std::uint32_t events) {
    epoll_event event{.events = events, .data = {.fd = descriptor}};
    if (events == 0) {
      ::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, descriptor, nullptr);
    } else if (::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, descriptor, &event) != 0) {
      ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, descriptor, &event);
    }
  }

  /// The descriptor of the set.
  [[nodiscard]] int descriptor() const { return epoll_.get(); }

 private:
  Descriptor epoll_;
};

}  // namespace canhil
