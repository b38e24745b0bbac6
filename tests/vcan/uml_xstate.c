// A library for LD_PRELOAD into user-mode Linux (6.1). User-mode Linux saves 2696 bytes of the extended registers of a process. This is enough for CPUs
// up to AVX-512 and PKRU. However, PTRACE_SETREGSET accepts only the complete set of registers. Therefore, on a CPU with more registers (AMX: 11008 bytes),
// the first process dies with "ptrace set fp regs failed, errno = 14". This library fills the missing part with the current registers of the process.
// Programs in the guest then cannot use AMX; all other registers are preserved.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <elf.h>
#include <stdarg.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/uio.h>

long ptrace(enum __ptrace_request request, ...) {
  static long (*next)(enum __ptrace_request, ...);
  static char whole[65536];
  va_list arguments;
  va_start(arguments, request);
  const int process = va_arg(arguments, int);
  void* address = va_arg(arguments, void*);
  void* data = va_arg(arguments, void*);
  va_end(arguments);
  if (!next) next = (long (*)(enum __ptrace_request, ...))dlsym(RTLD_NEXT, "ptrace");

  if (request == PTRACE_SETREGSET && (long)address == NT_X86_XSTATE) {
    const struct iovec* known = data;
    struct iovec all = {whole, sizeof whole};
    if (next(PTRACE_GETREGSET, process, address, &all) == 0 && all.iov_len > known->iov_len) {
      memcpy(whole, known->iov_base, known->iov_len);
      return next(request, process, address, &all);
    }
  }
  return next(request, process, address, data);
}
