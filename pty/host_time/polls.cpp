// poll, select and epoll of a host in simulated time.
//
// Each call checks first, then waits as the bench decides, and checks again. A wait for nothing but sockets
// to other machines happens in real time, while simulated time is stopped.
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

namespace {

/// Returns true for a connection with another machine.
bool is_connected_outside(int descriptor) {
  sockaddr_in6 peer;
  socklen_t size = sizeof peer;
  const int error = errno;
  const bool is_connected = getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &size) == 0;
  errno = error;
  if (!is_connected) return false;
  if (peer.sin6_family == AF_INET6) {
    return !IN6_IS_ADDR_LOOPBACK(&peer.sin6_addr) &&
           !(IN6_IS_ADDR_V4MAPPED(&peer.sin6_addr) && peer.sin6_addr.s6_addr[12] == IN_LOOPBACKNET);
  }
  if (peer.sin6_family != AF_INET) return false;
  sockaddr_in address;
  memcpy(&address, &peer, sizeof address);
  return ntohl(address.sin_addr.s_addr) >> IN_CLASSA_NSHIFT != IN_LOOPBACKNET;
}

/// Sorts the descriptors of a wait into lines of the bench and others, which it stores.
class Sorted {
 public:
  explicit Sorted(nfds_t max) {
    if (max > kFew) others_ = static_cast<pollfd*>(malloc(max * sizeof(pollfd)));
  }
  ~Sorted() {
    if (others_ != few_) free(others_);
  }
  Sorted(const Sorted&) = delete;
  Sorted& operator=(const Sorted&) = delete;

  void add(int descriptor, short events, Wait& wait) {
    if (descriptor < 0) return;
    int number = -1;
    if (is_line(descriptor, &number) || is_door(descriptor, &number)) {
      wait.add_line(number);
      is_all_outside_ = false;
      return;
    }
    if (!is_connected_outside(descriptor)) is_all_outside_ = false;
    is_empty_ = false;
    others_[wait.other_count++] = {descriptor, events, 0};
    wait.others = others_;
  }
  /// A hang-up wakes the thread, but select may not count it: such descriptors must not wake it again and
  /// again. Returns true if there was one.
  static bool forget_hung_up(Wait& wait) {
    bool has_forgotten = false;
    for (nfds_t i = 0; i < wait.other_count; ++i) {
      pollfd& other = wait.others[i];
      if (other.fd < 0 || UNDERSTUDY_REAL(poll)(&other, 1, 0) <= 0 || (other.revents & other.events) != 0)
        continue;
      other.fd = -1;
      has_forgotten = true;
    }
    return has_forgotten;
  }
  /// Returns true if all descriptors are sockets to other machines.
  bool is_all_outside() const { return is_all_outside_ && !is_empty_; }

 private:
  static constexpr nfds_t kFew = 16;
  pollfd few_[kFew];
  pollfd* others_ = few_;
  bool is_all_outside_ = true;
  bool is_empty_ = true;
};

/// Waits in real time while simulated time is stopped. If nothing is ready after that, the same time passes
/// in the simulation.
template <class Look>
int look_outside(int64_t length_ns, Look look) {
  begin_outside();
  const int ready = look(length_ns);
  const int error = errno;
  end_outside();
  if (ready == 0 && length_ns != kNever) sleep_until(after(length_ns));
  errno = error;
  return ready;
}

/// `look(length)` waits for up to `length` in real time, and returns how many descriptors are ready, or -1.
/// The caller has already called it once without a wait, and it found nothing.
template <class Look>
int wait_in_turn(int64_t length_ns, const Sorted& sorted, Wait& wait, Look look) {
  if (sorted.is_all_outside()) return look_outside(length_ns, look);
  const int64_t until = length_ns == kNever ? kNever : after(length_ns);
  wait.until_ns = until;
  while (true) {
    const Woken woken = wait_for(wait);
    int ready = look(0);
    if (ready == 0 && woken == Woken::by_descriptor && Sorted::forget_hung_up(wait)) ready = look(0);
    if (ready != 0) return ready;
    if (woken == Woken::by_signal) {
      errno = EINTR;
      return -1;
    }
    if (now_ns() >= until) return 0;
  }
}

/// Gives a wait of no length that has found nothing the length of a check. Returns false if that is none.
bool take_check(int64_t& length_ns, Wait& wait) {
  if (length_ns != 0) return true;
  length_ns = length_of_check();
  wait.is_check = true;
  return length_ns != 0;
}

timespec real_length(int64_t length_ns) { return time_of(length_ns); }

int poll_for(pollfd* entries, nfds_t count, int64_t length_ns, const sigset_t* mask) {
  const auto look = [&](int64_t length) {
    const timespec time = real_length(length);
    return UNDERSTUDY_REAL(ppoll)(entries, count, length == kNever ? nullptr : &time, mask);
  };
  const int ready = look(0);
  Wait wait;
  if (ready != 0 || !take_check(length_ns, wait)) return ready;
  Sorted sorted(count);
  wait.mask = mask;
  for (nfds_t i = 0; i < count; ++i) sorted.add(entries[i].fd, entries[i].events, wait);
  return wait_in_turn(length_ns, sorted, wait, look);
}

/// The descriptor sets of a select. The kernel changes only the part that it was asked for.
class Sets {
 public:
  Sets(int count, fd_set* reads, fd_set* writes, fd_set* excepts)
      : count_(count < 0            ? 0
               : count < FD_SETSIZE ? count
                                    : FD_SETSIZE),
        given_{reads, writes, excepts} {
    for (int set = 0; set < 3; ++set) {
      FD_ZERO(&asked_[set]);
      if (given_[set] != nullptr) memcpy(&asked_[set], given_[set], size());
    }
  }
  void restore() {
    for (int set = 0; set < 3; ++set) {
      if (given_[set] != nullptr) memcpy(given_[set], &asked_[set], size());
    }
  }
  /// Removes descriptors that another thread has closed: they do not end a running select, and are never
  /// ready.
  void forget_closed() {
    for (int i = 0; i < count_; ++i) {
      if (events(i) == 0 || fcntl(i, F_GETFD) >= 0) continue;
      for (fd_set& set : asked_) FD_CLR(i, &set);
    }
  }
  int count() const { return count_; }
  short events(int descriptor) const {
    constexpr short kEvents[3] = {POLLIN, POLLOUT, POLLPRI};
    short events = 0;
    for (int set = 0; set < 3; ++set) {
      if (FD_ISSET(descriptor, &asked_[set])) events = static_cast<short>(events | kEvents[set]);
    }
    return events;
  }

 private:
  size_t size() const { return static_cast<size_t>(count_ + NFDBITS - 1) / NFDBITS * sizeof(fd_mask); }

  int count_;
  fd_set* given_[3];
  fd_set asked_[3];
};

int select_for(int count, fd_set* reads, fd_set* writes, fd_set* excepts, int64_t length_ns,
               const sigset_t* mask) {
  Sets sets(count, reads, writes, excepts);
  const auto look = [&](int64_t length) {
    sets.restore();
    const timespec time = real_length(length);
    return UNDERSTUDY_REAL(pselect)(count, reads, writes, excepts, length == kNever ? nullptr : &time, mask);
  };
  const int ready = look(0);
  Wait wait;
  if (ready != 0 || !take_check(length_ns, wait)) return ready;
  Sorted sorted(static_cast<nfds_t>(sets.count()));
  wait.mask = mask;
  for (int i = 0; i < sets.count(); ++i) {
    if (sets.events(i) != 0) sorted.add(i, sets.events(i), wait);
  }
  return wait_in_turn(length_ns, sorted, wait, [&](int64_t length) {
    const int found = look(length);
    if (found >= 0 || errno != EBADF) return found;
    sets.forget_closed();
    return look(length);
  });
}

int epoll_for(int descriptor, epoll_event* events, int count, int64_t length_ns, const sigset_t* mask) {
  const auto look = [&] { return UNDERSTUDY_REAL(epoll_pwait)(descriptor, events, count, 0, mask); };
  const int ready = look();
  Wait wait;
  if (ready != 0 || !take_check(length_ns, wait)) return ready;
  Sorted sorted(1);
  wait.mask = mask;
  sorted.add(descriptor, POLLIN, wait);
  wait.line_count = kAnyLine;
  return wait_in_turn(length_ns, sorted, wait, [&](int64_t) {
    const int found = look();
    return found < 0 && errno == EBADF ? 0 : found;  // it was closed: the wait continues
  });
}

int64_t length_of_ms(int milliseconds) {
  return milliseconds < 0 ? kNever : int64_t{milliseconds} * 1'000'000;
}

/// Converts a timeout. Returns false, with errno set, if it is not valid.
bool take_length(const timespec* time, int64_t& length_ns) {
  length_ns = time == nullptr ? kNever : ns_of(*time);
  if (length_ns >= 0) return true;
  errno = EINVAL;
  return false;
}

}  // namespace

UNDERSTUDY_EXPORT int poll(pollfd* entries, nfds_t count, int timeout) {
  if (!is_active()) return UNDERSTUDY_REAL(poll)(entries, count, timeout);
  return poll_for(entries, count, length_of_ms(timeout), nullptr);
}

UNDERSTUDY_EXPORT int __poll_chk(pollfd* entries, nfds_t count, int timeout, size_t size) {
  if (size / sizeof(pollfd) < count) abort();
  return poll(entries, count, timeout);
}

UNDERSTUDY_EXPORT int ppoll(pollfd* entries, nfds_t count, const timespec* timeout, const sigset_t* mask) {
  int64_t length = 0;
  if (!is_active()) return UNDERSTUDY_REAL(ppoll)(entries, count, timeout, mask);
  return take_length(timeout, length) ? poll_for(entries, count, length, mask) : -1;
}

UNDERSTUDY_EXPORT int __ppoll_chk(pollfd* entries, nfds_t count, const timespec* timeout,
                                  const sigset_t* mask, size_t size) {
  if (size / sizeof(pollfd) < count) abort();
  return ppoll(entries, count, timeout, mask);
}

UNDERSTUDY_EXPORT int select(int count, fd_set* reads, fd_set* writes, fd_set* excepts, timeval* timeout) {
  if (!is_active()) return UNDERSTUDY_REAL(select)(count, reads, writes, excepts, timeout);
  const int64_t length = timeout == nullptr ? kNever : ns_of(*timeout);
  if (length < 0) {
    errno = EINVAL;
    return -1;
  }
  const int64_t until = after(length);
  const int result = select_for(count, reads, writes, excepts, length, nullptr);
  if (timeout != nullptr && length != kNever) {  // Linux returns the remaining time
    const int64_t now = now_ns();
    const timespec rest = time_of(until > now ? until - now : 0);
    *timeout = {rest.tv_sec, rest.tv_nsec / 1'000};
  }
  return result;
}

UNDERSTUDY_EXPORT int pselect(int count, fd_set* reads, fd_set* writes, fd_set* excepts,
                              const timespec* timeout, const sigset_t* mask) {
  int64_t length = 0;
  if (!is_active()) return UNDERSTUDY_REAL(pselect)(count, reads, writes, excepts, timeout, mask);
  return take_length(timeout, length) ? select_for(count, reads, writes, excepts, length, mask) : -1;
}

UNDERSTUDY_EXPORT int epoll_wait(int descriptor, epoll_event* events, int count, int timeout) {
  if (!is_active()) return UNDERSTUDY_REAL(epoll_wait)(descriptor, events, count, timeout);
  return epoll_for(descriptor, events, count, length_of_ms(timeout), nullptr);
}

UNDERSTUDY_EXPORT int epoll_pwait(int descriptor, epoll_event* events, int count, int timeout,
                                  const sigset_t* mask) {
  if (!is_active()) return UNDERSTUDY_REAL(epoll_pwait)(descriptor, events, count, timeout, mask);
  return epoll_for(descriptor, events, count, length_of_ms(timeout), mask);
}

UNDERSTUDY_EXPORT int epoll_pwait2(int descriptor, epoll_event* events, int count, const timespec* timeout,
                                   const sigset_t* mask) {
  int64_t length = 0;
  if (!is_active()) return UNDERSTUDY_REAL(epoll_pwait2)(descriptor, events, count, timeout, mask);
  return take_length(timeout, length) ? epoll_for(descriptor, events, count, length, mask) : -1;
}
