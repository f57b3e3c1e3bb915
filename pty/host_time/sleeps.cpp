// Sleeps of a host in simulated time.
#include <errno.h>
#include <threads.h>
#include <unistd.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

namespace {

/// Returns the remaining time of a sleep, at least 0.
int64_t rest_until(int64_t until_ns) {
  const int64_t now = now_ns();
  return until_ns > now ? until_ns - now : 0;
}

/// Returns 0 or an error, as clock_nanosleep does.
int sleep_for(int64_t length_ns, timespec* rest) {
  if (length_ns < 0) return EINVAL;
  const int64_t until = after(length_ns);
  if (sleep_until(until)) return 0;
  if (rest != nullptr) *rest = time_of(rest_until(until));
  return EINTR;
}

}  // namespace

UNDERSTUDY_EXPORT int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* rest) {
  if (!is_active() || !is_for_waits(clock) || time == nullptr)
    return UNDERSTUDY_REAL(clock_nanosleep)(clock, flags, time, rest);
  const int64_t ns = ns_of(*time);
  if ((flags & TIMER_ABSTIME) == 0) return sleep_for(ns, rest);
  if (ns < 0) return EINVAL;
  return sleep_until(ns == kNever ? kNever : ns - clock_begin_ns(clock)) ? 0 : EINTR;
}

UNDERSTUDY_EXPORT int nanosleep(const timespec* time, timespec* rest) {
  if (!is_active() || time == nullptr) return UNDERSTUDY_REAL(nanosleep)(time, rest);
  const int error = sleep_for(ns_of(*time), rest);
  if (error == 0) return 0;
  errno = error;
  return -1;
}

UNDERSTUDY_EXPORT int usleep(useconds_t length) {
  if (!is_active()) return UNDERSTUDY_REAL(usleep)(length);
  if (sleep_for(int64_t{length} * 1'000, nullptr) == 0) return 0;
  errno = EINTR;
  return -1;
}

UNDERSTUDY_EXPORT unsigned sleep(unsigned length) {
  if (!is_active()) return UNDERSTUDY_REAL(sleep)(length);
  timespec rest = {};
  if (sleep_for(int64_t{length} * kBillion, &rest) == 0) return 0;
  return static_cast<unsigned>(rest.tv_sec);
}

UNDERSTUDY_EXPORT int thrd_sleep(const timespec* time, timespec* rest) {
  if (!is_active()) return UNDERSTUDY_REAL(thrd_sleep)(time, rest);
  const int error = sleep_for(ns_of(*time), rest);
  return error == 0 ? 0 : error == EINTR ? -1 : -2;
}
