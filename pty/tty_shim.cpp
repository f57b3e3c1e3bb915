// A library to preload into a host that insists on parity (understudy exec --tty-shim). A Linux pty drops
// parity, and libc then returns EINVAL although everything else was set. This library turns that one error
// into success, only on a pseudo-terminal and only for parity. tty_shim_ioctl.cpp has the other features of
// a serial port.
//
// It runs in another program's process, so it uses only libc and reports no errors of its own.
#include <dlfcn.h>
#include <errno.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>

#include "pty/tty_shim.h"

// /dev/pts has the kernel's majors 136 to 143.
int understudy::shim::pseudo_terminal_number(int descriptor) {
  constexpr unsigned kFirstMajor = 136;
  constexpr unsigned kLastMajor = 143;
  constexpr unsigned kMinorsOfAMajor = 1U << 20;
  const int error = errno;
  struct stat status;
  const bool is_known = fstat(descriptor, &status) == 0;
  errno = error;
  if (!is_known || !S_ISCHR(status.st_mode)) return -1;
  const unsigned number = major(status.st_rdev);
  if (number < kFirstMajor || number > kLastMajor) return -1;
  return static_cast<int>((number - kFirstMajor) * kMinorsOfAMajor + minor(status.st_rdev));
}

namespace {

using SetAttributes = int (*)(int, int, const termios*);

constexpr tcflag_t kParity = PARENB | PARODD;

SetAttributes real_tcsetattr() {
  // A static of a plain type has no guard, so it does not need the C++ library.
  static SetAttributes found = nullptr;
  if (found == nullptr) found = reinterpret_cast<SetAttributes>(dlsym(RTLD_NEXT, "tcsetattr"));
  return found;
}

/// The speed is part of c_cflag.
bool all_but_parity_is_set(int descriptor, const termios& asked) {
  termios present;
  if (tcgetattr(descriptor, &present) != 0) return false;
  return present.c_iflag == asked.c_iflag && present.c_oflag == asked.c_oflag &&
         present.c_lflag == asked.c_lflag && ((present.c_cflag ^ asked.c_cflag) & ~kParity) == 0 &&
         present.c_cc[VMIN] == asked.c_cc[VMIN] && present.c_cc[VTIME] == asked.c_cc[VTIME];
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int tcsetattr(int fd, int optional_actions,
                                                                const termios* termios_p) noexcept {
  const SetAttributes set = real_tcsetattr();
  if (set == nullptr) {
    errno = ENOSYS;
    return -1;
  }
  const bool is_terminal = understudy::shim::pseudo_terminal_number(fd) >= 0;
  if (optional_actions != TCSANOW && is_terminal) tcdrain(fd);
  // The call is tried twice, because the other end may have put the line back to rest in between.
  for (int attempt = 0; attempt < 2; ++attempt) {
    const int result = set(fd, optional_actions, termios_p);
    if (result == 0 || errno != EINVAL) return result;
    if ((termios_p->c_cflag & PARENB) == 0 || !is_terminal) break;
    if (all_but_parity_is_set(fd, *termios_p)) return 0;
  }
  errno = EINVAL;
  return -1;
}
