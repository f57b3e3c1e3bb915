// Clocks of a host in simulated time. They show the time of the shared page, and stand still while the host
// computes.
#include <errno.h>
#include <sys/time.h>

#include "pty/host_time/shim.h"

namespace understudy::host_time {

int64_t clock_begin_ns(clockid_t clock) {
  switch (clock) {
    case CLOCK_REALTIME:
    case CLOCK_REALTIME_COARSE:
    case CLOCK_REALTIME_ALARM:
    case CLOCK_TAI: return kDateAtBegin_s * kBillion;
    case CLOCK_MONOTONIC:
    case CLOCK_MONOTONIC_RAW:
    case CLOCK_MONOTONIC_COARSE:
    case CLOCK_BOOTTIME:
    case CLOCK_BOOTTIME_ALARM: return kUptimeAtBegin_s * kBillion;
    default: return -1;  // a clock of processor time
  }
}

bool is_for_waits(clockid_t clock) {
  switch (clock) {
    case CLOCK_REALTIME:
    case CLOCK_MONOTONIC:
    case CLOCK_BOOTTIME:
    case CLOCK_TAI:
    case CLOCK_REALTIME_ALARM:
    case CLOCK_BOOTTIME_ALARM: return true;
    default: return false;
  }
}

timespec time_of(int64_t ns) { return {ns / kBillion, ns % kBillion}; }

int64_t ns_of(const timespec& time) {
  if (time.tv_sec < 0 || time.tv_nsec < 0 || time.tv_nsec >= kBillion) return -1;
  constexpr int64_t kMax_s = kNever / kBillion - 1;
  return time.tv_sec >= kMax_s ? kNever : time.tv_sec * kBillion + time.tv_nsec;
}

int64_t ns_of(const timeval& time) {
  if (time.tv_sec < 0 || time.tv_usec < 0) return -1;
  const timespec same = {time.tv_sec + time.tv_usec / 1'000'000, time.tv_usec % 1'000'000 * 1'000};
  return ns_of(same);
}

int64_t after(int64_t length_ns) {
  const int64_t now = now_ns();
  return length_ns >= kNever - now ? kNever : now + length_ns;
}

}  // namespace understudy::host_time

using namespace understudy::host_time;

UNDERSTUDY_EXPORT int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const int64_t begin = is_active() ? clock_begin_ns(clock) : -1;
  if (begin < 0) return UNDERSTUDY_REAL(clock_gettime)(clock, time);
  *time = time_of(begin + now_ns());
  return 0;
}

UNDERSTUDY_EXPORT int gettimeofday(timeval* time, void* zone) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(gettimeofday)(time, zone);
  const timespec now = time_of(clock_begin_ns(CLOCK_REALTIME) + now_ns());
  *time = {now.tv_sec, now.tv_nsec / 1'000};
  return 0;
}

UNDERSTUDY_EXPORT time_t time(time_t* place) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(time)(place);
  const time_t now = time_of(clock_begin_ns(CLOCK_REALTIME) + now_ns()).tv_sec;
  if (place != nullptr) *place = now;
  return now;
}

UNDERSTUDY_EXPORT int timespec_get(timespec* time, int base) noexcept {
  if (!is_active() || base != TIME_UTC) return UNDERSTUDY_REAL(timespec_get)(time, base);
  clock_gettime(CLOCK_REALTIME, time);
  return base;
}

/// The structure from <sys/timeb.h>. New programs can no longer call ftime, but old ones do.
struct timeb_of_old {
  time_t time;
  unsigned short millitm;
  short timezone;
  short dstflag;
};

UNDERSTUDY_EXPORT int ftime(timeb_of_old* place) noexcept {
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  *place = {now.tv_sec, static_cast<unsigned short>(now.tv_nsec / 1'000'000), 0, 0};
  return 0;
}
