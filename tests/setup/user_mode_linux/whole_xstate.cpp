// Preloaded into user-mode Linux: lets it run on hosts whose processors have more register state than it
// knows of.
//
// User-mode Linux 6.1 keeps 2696 bytes of XSAVE state for each task (x87, SSE, AVX, AVX-512, PKRU). The host
// takes back only a whole state (xstateregs_set() in Linux: EFAULT for a shorter one), which on processors
// with AMX has 11008 bytes. What the guest does not know it cannot have used: those bytes are zero, and the
// header's bit vector, which travels within the known part, says that these components are in their initial
// state.
#include <dlfcn.h>
#include <elf.h>
#include <sys/ptrace.h>
#include <sys/uio.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstring>

namespace {

using Ptrace = long (*)(int, pid_t, void*, void*);
constexpr std::size_t most_state = 65536;

std::size_t size_on_host(Ptrace real, pid_t pid) {
  static std::array<char, most_state> state;
  iovec whole{state.data(), state.size()};
  return real(PTRACE_GETREGSET, pid, reinterpret_cast<void*>(NT_X86_XSTATE), &whole) == 0 ? whole.iov_len : 0;
}

}  // namespace

extern "C" long ptrace(enum __ptrace_request request, ...) noexcept {
  static const auto real = reinterpret_cast<Ptrace>(dlsym(RTLD_NEXT, "ptrace"));
  va_list arguments;
  va_start(arguments, request);
  const pid_t pid = va_arg(arguments, pid_t);
  void* const address = va_arg(arguments, void*);
  void* const data = va_arg(arguments, void*);
  va_end(arguments);
  if (request == PTRACE_SETREGSET && reinterpret_cast<long>(address) == NT_X86_XSTATE) {
    static const std::size_t whole_size = size_on_host(real, pid);
    const auto* known = static_cast<const iovec*>(data);
    if (known->iov_len < whole_size) {
      static std::array<char, most_state>
          state;  // zero behind the known part; user-mode Linux has one thread here
      std::memcpy(state.data(), known->iov_base, known->iov_len);
      iovec whole{state.data(), whole_size};
      return real(request, pid, address, &whole);
    }
  }
  return real(request, pid, address, data);
}
