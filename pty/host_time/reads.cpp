// Reads that wait for a line of the bench according to the terminal's VMIN and VTIME, writes that wait until
// the line has room, and tcdrain.
#include <alloca.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/uio.h>
#include <termios.h>
#include <unistd.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

namespace {

constexpr int64_t kTenth_ns = kBillion / 10;  // the unit of VTIME

/// How a read waits.
struct Patience {
  bool is_canonical = false;
  size_t min = 1;  // bytes
  int64_t length_ns = kNever;
  bool is_between_bytes = false;  // the length starts again with each byte
};

/// Returns false if a read of the line does not wait.
bool take_patience(int descriptor, size_t size, Patience& patience) {
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0 || (flags & O_NONBLOCK) != 0) return false;
  termios settings;
  if (tcgetattr(descriptor, &settings) != 0) return false;
  if ((settings.c_lflag & ICANON) != 0) {
    patience.is_canonical = true;
    return true;
  }
  const size_t min = settings.c_cc[VMIN];
  const int64_t tenths = settings.c_cc[VTIME];
  if (min == 0 && tenths == 0) return false;
  if (min > 0) patience.min = min < size ? min : size;
  if (tenths > 0) patience.length_ns = tenths * kTenth_ns;
  patience.is_between_bytes = min > 0 && tenths > 0;
  return true;
}

/// Waits until a read of the line would not block. Returns how many bytes the read may ask for; 0: the time
/// is up; -1: a signal arrived.
ssize_t wait_for_bytes(int descriptor, int number, size_t size, const Patience& patience) {
  Wait wait;
  wait.add_line(number);
  wait.is_restartable = true;
  if (patience.length_ns != kNever && !patience.is_between_bytes) wait.until_ns = after(patience.length_ns);
  int present_before = 0;
  for (bool has_waited = false;; has_waited = true) {
    pollfd entry = {descriptor, POLLIN, 0};
    UNDERSTUDY_REAL(poll)(&entry, 1, 0);
    const bool is_closed = (entry.revents & POLLNVAL) != 0;
    if ((entry.revents & (POLLHUP | POLLERR)) != 0 || (is_closed && !has_waited))
      return static_cast<ssize_t>(size);
    int present = 0;
    if (is_closed) {  // another thread has closed it, which does not end a read
      if (now_ns() >= wait.until_ns) return 0;
    } else if (patience.is_canonical) {
      if ((entry.revents & POLLIN) != 0) return static_cast<ssize_t>(size);
    } else {
      if (ioctl(descriptor, FIONREAD, &present) != 0) return static_cast<ssize_t>(size);
      const size_t max = static_cast<size_t>(present) < size ? static_cast<size_t>(present) : size;
      if (max >= patience.min) return static_cast<ssize_t>(max);
      if (patience.is_between_bytes && present > present_before) wait.until_ns = after(patience.length_ns);
      present_before = present;
      if (now_ns() >= wait.until_ns) return static_cast<ssize_t>(max);
    }
    if (wait_for(wait) == Woken::by_signal) {
      errno = EINTR;
      return -1;
    }
  }
}

}  // namespace

namespace {

/// A read that does not wait only checks whether the line has anything.
void check_line(int descriptor, int number) {
  pollfd entry = {descriptor, POLLIN, 0};
  if (UNDERSTUDY_REAL(poll)(&entry, 1, 0) != 0) return;
  const int64_t length_ns = length_of_check();
  if (length_ns == 0) return;
  Wait wait;
  wait.add_line(number);
  wait.is_check = true;
  wait.until_ns = after(length_ns);
  wait_for(wait);
}

/// Waits until a timer has expired. Returns false if a signal arrived.
bool wait_for_timer(int descriptor) {
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0 || (flags & O_NONBLOCK) != 0) return true;
  pollfd entry = {descriptor, POLLIN, 0};
  return poll(&entry, 1, -1) >= 0;
}

}  // namespace

ssize_t understudy::host_time::wait_to_read(int descriptor, size_t size) {
  constexpr ssize_t kAll = SSIZE_MAX;
  if (!is_active() || size == 0) return kAll;
  if (size >= sizeof(uint64_t) && is_timer(descriptor) && !wait_for_timer(descriptor)) return -1;
  if (!wait_for_connection(descriptor)) return -1;
  int number = -1;
  Patience patience;
  if (!is_line(descriptor, &number)) return kAll;
  if (take_patience(descriptor, size, patience)) return wait_for_bytes(descriptor, number, size, patience);
  check_line(descriptor, number);
  return kAll;
}

UNDERSTUDY_EXPORT ssize_t read(int descriptor, void* place, size_t size) {
  const ssize_t max = wait_to_read(descriptor, size);
  if (max <= 0) return max;
  const auto room = static_cast<size_t>(max);
  return UNDERSTUDY_REAL(read)(descriptor, place, room < size ? room : size);
}

UNDERSTUDY_EXPORT ssize_t __read_chk(int descriptor, void* place, size_t size, size_t room) {
  if (size > room) abort();
  return read(descriptor, place, size);
}

UNDERSTUDY_EXPORT ssize_t readv(int descriptor, const iovec* parts, int count) {
  size_t size = 0;
  const bool is_good = is_active() && count > 0 && count <= IOV_MAX;
  for (int i = 0; is_good && i < count; ++i) size += parts[i].iov_len;
  const ssize_t max = wait_to_read(descriptor, size);
  if (max <= 0) return max;
  if (static_cast<size_t>(max) >= size) return UNDERSTUDY_REAL(readv)(descriptor, parts, count);
  auto* const shorter = static_cast<iovec*>(alloca(static_cast<size_t>(count) * sizeof(iovec)));
  size_t rest = static_cast<size_t>(max);
  int used = 0;
  for (; rest > 0; ++used) {
    shorter[used] = parts[used];
    if (shorter[used].iov_len > rest) shorter[used].iov_len = rest;
    rest -= shorter[used].iov_len;
  }
  return UNDERSTUDY_REAL(readv)(descriptor, shorter, used);
}

namespace {

// A line that accepts anything accepts this much, so only longer writes may wait.
constexpr size_t kSurelyTaken = 1024;

/// Returns true if a write may wait for the line.
bool may_wait_to_write(int descriptor, size_t size, int* number) {
  if (!is_active() || size == 0 || !is_line(descriptor, number)) return false;
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0 || (flags & O_NONBLOCK) != 0) return false;
  pollfd entry = {descriptor, POLLOUT, 0};
  return size > kSurelyTaken || UNDERSTUDY_REAL(poll)(&entry, 1, 0) == 0;
}

/// Writes without waiting in the kernel, where the bench could not see it.
ssize_t write_some(int descriptor, const void* place, size_t size) {
  const int flags = fcntl(descriptor, F_GETFL);
  fcntl(descriptor, F_SETFL, flags | O_NONBLOCK);
  const ssize_t count = UNDERSTUDY_REAL(write)(descriptor, place, size);
  const int error = errno;
  fcntl(descriptor, F_SETFL, flags);
  errno = error;
  return count;
}

}  // namespace

UNDERSTUDY_EXPORT ssize_t write(int descriptor, const void* place, size_t size) {
  int number = -1;
  if (!may_wait_to_write(descriptor, size, &number)) return UNDERSTUDY_REAL(write)(descriptor, place, size);
  size_t done = 0;
  while (done < size) {
    const ssize_t count = write_some(descriptor, static_cast<const char*>(place) + done, size - done);
    if (count > 0) {
      done += static_cast<size_t>(count);
      continue;
    }
    if (count < 0 && errno != EAGAIN) return done > 0 ? static_cast<ssize_t>(done) : -1;
    Wait wait;
    wait.add_line(number);
    wait.is_restartable = true;
    if (wait_for(wait) != Woken::by_signal) continue;
    errno = EINTR;
    return done > 0 ? static_cast<ssize_t>(done) : -1;
  }
  return static_cast<ssize_t>(done);
}

UNDERSTUDY_EXPORT int tcdrain(int descriptor) {
  int number = -1;
  if (!is_active() || !is_line(descriptor, &number)) return UNDERSTUDY_REAL(tcdrain)(descriptor);
  Wait wait;
  wait.add_line(number);
  wait.is_for_drain = true;
  wait.is_restartable = true;
  if (wait_for(wait) != Woken::by_signal) return 0;
  errno = EINTR;
  return -1;
}
