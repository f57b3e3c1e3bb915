// Signals when a byte arrives on a line (O_ASYNC, SIGIO). The bench sends them, as it sends those of timers:
// it must know that time may not pass over the byte, and the kernel's thread that carries bytes would send
// them at a moment of its own. So the kernel never learns that a line has O_ASYNC.
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <unistd.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

namespace {

constexpr int kMaxDescriptors = 1024;
int numbers[kMaxDescriptors];  // the line with O_ASYNC that a descriptor is, plus 1; 0: it has none

bool is_watched(int descriptor) {
  int number = -1;
  return descriptor >= 0 && descriptor < kMaxDescriptors && numbers[descriptor] != 0 &&
         is_line(descriptor, &number) && numbers[descriptor] == number + 1;
}

/// Tells the bench who gets which signal.
void tell(int descriptor, int number, bool is_on) {
  static_assert(int{owner_thread} == int{F_OWNER_TID} && int{owner_process} == int{F_OWNER_PID} &&
                int{owner_group} == int{F_OWNER_PGRP});
  Message message = {};
  message.what = MessageKind::watch;
  message.sequence = static_cast<uint32_t>(descriptor);
  message.line_count = 1;
  message.lines[0] = number;
  if (is_on) {
    const auto control = UNDERSTUDY_REAL(fcntl);
    f_owner_ex owner = {F_OWNER_PID, 0};
    control(descriptor, F_GETOWN_EX, &owner);
    message.value = owner.pid == 0 ? int64_t{F_OWNER_PID} : int64_t{owner.type};
    message.target = owner.pid == 0 ? getpid() : owner.pid;
    const int chosen = control(descriptor, F_GETSIG);
    message.signal = chosen > 0 ? chosen : SIGIO;
  }
  tell_watch(message);
}

/// Sets the flags of a line as fcntl() does.
int set_flags(int descriptor, int number, int flags) {
  const bool was_on = is_watched(descriptor);
  const bool is_on = (flags & O_ASYNC) != 0;
  const int result = UNDERSTUDY_REAL(fcntl)(descriptor, F_SETFL, flags & ~O_ASYNC);
  if (result < 0 || is_on == was_on) return result;
  numbers[descriptor] = is_on ? number + 1 : 0;
  tell(descriptor, number, is_on);
  return result;
}

int control(int descriptor, int command, void* argument) {
  int number = -1;
  const bool is_ours = is_active() && descriptor >= 0 && descriptor < kMaxDescriptors;
  if (is_ours && command == F_SETFL && is_line(descriptor, &number))
    return set_flags(descriptor, number, static_cast<int>(reinterpret_cast<intptr_t>(argument)));
  const int result = UNDERSTUDY_REAL(fcntl)(descriptor, command, argument);
  if (!is_ours || result < 0 || numbers[descriptor] == 0 || !is_watched(descriptor)) return result;
  if (command == F_GETFL) return result | O_ASYNC;
  if (command == F_SETOWN || command == F_SETOWN_EX || command == F_SETSIG)
    tell(descriptor, numbers[descriptor] - 1, true);
  return result;
}

}  // namespace

UNDERSTUDY_EXPORT int fcntl(int descriptor, int command, ...) {
  va_list list;
  va_start(list, command);
  void* const argument = va_arg(list, void*);
  va_end(list);
  return control(descriptor, command, argument);
}

UNDERSTUDY_EXPORT int fcntl64(int descriptor, int command, ...) {
  va_list list;
  va_start(list, command);
  void* const argument = va_arg(list, void*);
  va_end(list);
  return control(descriptor, command, argument);
}

UNDERSTUDY_EXPORT int close(int descriptor) {
  if (descriptor >= 0 && descriptor < kMaxDescriptors && numbers[descriptor] != 0) {
    const int number = numbers[descriptor] - 1;
    if (is_watched(descriptor)) tell(descriptor, number, false);
    numbers[descriptor] = 0;
  }
  return UNDERSTUDY_REAL(close)(descriptor);
}
