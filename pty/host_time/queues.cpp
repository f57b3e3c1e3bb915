// Timed waits for POSIX message queues, by which the processes of a host may talk. Their timeout is a date,
// and the kernel would compare it with its own.
#include <errno.h>
#include <fcntl.h>
#include <mqueue.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

namespace {

/// `try_once(time)` calls the kernel. A queue is a descriptor, which can be polled.
template <class Try>
auto wait_for_queue(mqd_t queue, short events, const timespec* time, Try try_once)
    -> decltype(try_once(time)) {
  const int flags = is_active() && time != nullptr ? fcntl(queue, F_GETFL) : -1;
  const int64_t ns = flags >= 0 ? ns_of(*time) : -1;
  if (ns < 0 || (flags & O_NONBLOCK) != 0) return try_once(time);
  const int64_t until = ns == kNever ? kNever : ns - clock_begin_ns(CLOCK_REALTIME);
  const timespec past = {0, 0};
  pollfd entry = {queue, events, 0};
  while (true) {
    const auto result = try_once(&past);
    if (result >= 0 || errno != ETIMEDOUT) return result;
    if (now_ns() >= until) {
      check_again();
      return result;
    }
    Wait wait;
    wait.until_ns = until;
    wait.others = &entry;
    wait.other_count = 1;
    if (wait_for(wait) != Woken::by_signal) continue;
    errno = EINTR;
    return result;
  }
}

}  // namespace

UNDERSTUDY_EXPORT ssize_t mq_timedreceive(mqd_t queue, char* place, size_t size, unsigned* priority,
                                          const timespec* time) {
  return wait_for_queue(queue, POLLIN, time, [&](const timespec* end) {
    return UNDERSTUDY_REAL(mq_timedreceive)(queue, place, size, priority, end);
  });
}

UNDERSTUDY_EXPORT int mq_timedsend(mqd_t queue, const char* text, size_t size, unsigned priority,
                                   const timespec* time) {
  return wait_for_queue(queue, POLLOUT, time, [&](const timespec* end) {
    return UNDERSTUDY_REAL(mq_timedsend)(queue, text, size, priority, end);
  });
}
