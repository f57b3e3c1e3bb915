// Adds features of a serial port that a pseudo-terminal lacks, for hosts that insist on them: modem lines,
// RS-485 mode and low latency. A pseudo-terminal answers ENOTTY to all of them. This library answers as a
// port whose other end is switched on and fully wired: CTS, DSR and CD are on; RTS and DTR are as the host
// last set them (initially on). RS-485 mode and low latency are remembered. None of it reaches the emulator.
//
// It runs in another program's process, so it uses only libc and reports no errors of its own.
#include <dlfcn.h>
#include <errno.h>
#include <linux/serial.h>
#include <stdarg.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "pty/tty_shim.h"

namespace {

using Ioctl = int (*)(int, unsigned long, ...);

constexpr int kOwnLines = TIOCM_RTS | TIOCM_DTR;
constexpr int kTheirLines = TIOCM_CTS | TIOCM_DSR | TIOCM_CD;

/// The state of one pseudo-terminal. It is all zero at first, so that unused ones cost no memory.
struct Remembered {
  int lowered;  // the lines among kOwnLines that are off
  int serial_flags;
  serial_rs485 rs485;
};

constexpr int kMaxPseudoTerminals = 4096;  // the kernel's own limit, unless it was raised
Remembered remembered[kMaxPseudoTerminals];

int call_real(int descriptor, unsigned long request, void* argument) {
  // A static of a plain type has no guard, so it does not need the C++ library.
  static Ioctl found = nullptr;
  if (found == nullptr) found = reinterpret_cast<Ioctl>(dlsym(RTLD_NEXT, "ioctl"));
  if (found == nullptr) return static_cast<int>(syscall(SYS_ioctl, descriptor, request, argument));
  return found(descriptor, request, argument);
}

bool is_offered(unsigned long request) {
  switch (request) {
    case TIOCMGET:
    case TIOCMSET:
    case TIOCMBIS:
    case TIOCMBIC:
    case TIOCGRS485:
    case TIOCSRS485:
    case TIOCGSERIAL:
    case TIOCSSERIAL: return true;
    default: return false;
  }
}

void answer(Remembered& port, unsigned long request, void* argument) {
  int lines = 0;
  serial_struct serial;
  switch (request) {
    case TIOCMGET:
      lines = kTheirLines | (kOwnLines & ~__atomic_load_n(&port.lowered, __ATOMIC_RELAXED));
      memcpy(argument, &lines, sizeof lines);
      break;
    case TIOCMSET:
      memcpy(&lines, argument, sizeof lines);
      __atomic_store_n(&port.lowered, kOwnLines & ~lines, __ATOMIC_RELAXED);
      break;
    case TIOCMBIS:
      memcpy(&lines, argument, sizeof lines);
      __atomic_fetch_and(&port.lowered, ~lines, __ATOMIC_RELAXED);
      break;
    case TIOCMBIC:
      memcpy(&lines, argument, sizeof lines);
      __atomic_fetch_or(&port.lowered, kOwnLines & lines, __ATOMIC_RELAXED);
      break;
    case TIOCGRS485: memcpy(argument, &port.rs485, sizeof port.rs485); break;
    case TIOCSRS485: memcpy(&port.rs485, argument, sizeof port.rs485); break;
    case TIOCGSERIAL:
      memset(&serial, 0, sizeof serial);
      serial.type = PORT_16550A;
      serial.flags = __atomic_load_n(&port.serial_flags, __ATOMIC_RELAXED);
      memcpy(argument, &serial, sizeof serial);
      break;
    case TIOCSSERIAL:
      memcpy(&serial, argument, sizeof serial);
      __atomic_store_n(&port.serial_flags, serial.flags, __ATOMIC_RELAXED);
      break;
    default: break;
  }
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  const int error = errno;
  const int result = call_real(fd, request, argument);
  // The kernel is asked first: a real port, or a feature of a later kernel, gives its own answer.
  if (result != -1 || (errno != ENOTTY && errno != EINVAL) || !is_offered(request)) return result;
  const int number = understudy::shim::pseudo_terminal_number(fd);
  if (number < 0 || number >= kMaxPseudoTerminals) return result;
  if (argument == nullptr) {
    errno = EFAULT;
    return -1;
  }
  answer(remembered[number], request, argument);
  errno = error;
  return 0;
}
