// Timed waits of threads for each other: conditions, semaphores, mutexes.
//
// libc waits for these in internal functions that cannot be replaced. So conditions are implemented entirely
// here: a count of signals, and a wait in the kernel until it changes. Semaphores keep libc's form, which no
// release may change, because programs have them in their memory.
#include <errno.h>
#include <linux/futex.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdarg.h>
#include <string.h>
#include <sys/syscall.h>
#include <threads.h>
#include <unistd.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

namespace {

/// Our form of a pthread_cond_t. A statically initialized one is all zero.
struct Condition {
  uint32_t signals;
  uint32_t waiters;
  uint32_t is_shared;
  clockid_t clock;  // CLOCK_REALTIME is 0
};
static_assert(sizeof(Condition) <= sizeof(pthread_cond_t));

Condition& condition_of(pthread_cond_t* condition) { return *reinterpret_cast<Condition*>(condition); }

void wake(Condition& condition, int max) {
  __atomic_fetch_add(&condition.signals, 1, __ATOMIC_ACQ_REL);
  if (__atomic_load_n(&condition.waiters, __ATOMIC_ACQUIRE) == 0) return;
  syscall(SYS_futex, &condition.signals, condition.is_shared != 0 ? FUTEX_WAKE : FUTEX_WAKE_PRIVATE, max,
          nullptr, nullptr, 0);
}

int wait_for_signal(pthread_cond_t* place, pthread_mutex_t* mutex, int64_t until_ns) {
  Condition& condition = condition_of(place);
  __atomic_fetch_add(&condition.waiters, 1, __ATOMIC_ACQ_REL);
  const uint32_t before = __atomic_load_n(&condition.signals, __ATOMIC_ACQUIRE);
  const int error = pthread_mutex_unlock(mutex);
  if (error != 0) {
    __atomic_fetch_sub(&condition.waiters, 1, __ATOMIC_ACQ_REL);
    return error;
  }
  Woken woken = Woken::by_signal;
  if (now_ns() >= until_ns) check_again();
  while (woken == Woken::by_signal && now_ns() < until_ns &&
         __atomic_load_n(&condition.signals, __ATOMIC_ACQUIRE) == before)
    woken = wait_on_word(&condition.signals, before, condition.is_shared != 0, until_ns);
  const bool is_signalled = __atomic_load_n(&condition.signals, __ATOMIC_ACQUIRE) != before;
  __atomic_fetch_sub(&condition.waiters, 1, __ATOMIC_ACQ_REL);
  pthread_mutex_lock(mutex);
  return !is_signalled && now_ns() >= until_ns ? ETIMEDOUT : 0;
}

/// Converts an absolute time of a clock to simulated time. Returns false if the time is not valid, or if libc
/// does not wait by that clock (it has two).
bool take_end(clockid_t clock, const timespec* time, int64_t& until_ns) {
  const int64_t begin = clock_begin_ns(clock);
  if ((clock != CLOCK_REALTIME && clock != CLOCK_MONOTONIC) || time->tv_nsec < 0 || time->tv_nsec >= kBillion)
    return false;
  const int64_t ns = ns_of(*time);
  until_ns = ns == kNever ? kNever : ns - begin;  // a time before the beginning is in the past
  return true;
}

/// Returns true if the thread number (the kernel's) is that of this thread.
bool is_own(int thread) { return thread == static_cast<int>(UNDERSTUDY_REAL(syscall)(SYS_gettid)); }

/// libc's form of a semaphore: the value in the low half, the waiters in the high one.
struct Semaphore {
  uint64_t value_and_waiters;
  int is_shared;
};
constexpr uint64_t kOneWaiter = uint64_t{1} << 32;

int wait_for_post(sem_t* place, clockid_t clock, const timespec* time) {
  int64_t until = kNever;
  if (!take_end(clock, time, until)) {
    errno = EINVAL;
    return -1;
  }
  if (sem_trywait(place) == 0) return 0;
  auto* const semaphore = reinterpret_cast<Semaphore*>(place);
  while (true) {
    __atomic_fetch_add(&semaphore->value_and_waiters, kOneWaiter, __ATOMIC_ACQ_REL);
    Woken woken = Woken::by_descriptor;
    if (now_ns() < until) {
      woken = wait_on_word(reinterpret_cast<uint32_t*>(semaphore), 0, semaphore->is_shared != 0, until);
    } else {
      check_again();
    }
    __atomic_fetch_sub(&semaphore->value_and_waiters, kOneWaiter, __ATOMIC_ACQ_REL);
    if (sem_trywait(place) == 0) return 0;
    if (woken == Woken::by_signal || now_ns() >= until) {
      errno = woken == Woken::by_signal ? EINTR : ETIMEDOUT;
      return -1;
    }
  }
}

/// Timed waits for locks are rare, so the lock is tried again and again in simulated time.
template <class Try>
int try_until(clockid_t clock, const timespec* time, Try try_once) {
  constexpr int64_t kMaxBetween_ns = 10'000'000;
  int64_t between_ns = 1'000'000;
  int64_t until = kNever;
  const bool has_end = take_end(clock, time, until);
  while (true) {
    const int error = try_once();
    if (error != EBUSY) return error;
    if (!has_end) return EINVAL;
    const int64_t now = now_ns();
    if (now >= until) {
      check_again();
      return ETIMEDOUT;
    }
    sleep_until(until - now < between_ns ? until : now + between_ns);
    if (between_ns < kMaxBetween_ns) between_ns *= 2;
  }
}

}  // namespace

// --- conditions ----------------------------------------------------------------------------------

UNDERSTUDY_EXPORT int pthread_cond_init(pthread_cond_t* place,
                                        const pthread_condattr_t* attributes) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_cond_init)(place, attributes);
  memset(static_cast<void*>(place), 0, sizeof *place);
  if (attributes == nullptr) return 0;
  Condition& condition = condition_of(place);
  int sharing = PTHREAD_PROCESS_PRIVATE;
  pthread_condattr_getclock(attributes, &condition.clock);
  pthread_condattr_getpshared(attributes, &sharing);
  condition.is_shared = sharing == PTHREAD_PROCESS_SHARED ? 1 : 0;
  return 0;
}

UNDERSTUDY_EXPORT int pthread_cond_destroy(pthread_cond_t* place) noexcept {
  return is_active() ? 0 : UNDERSTUDY_REAL(pthread_cond_destroy)(place);
}

UNDERSTUDY_EXPORT int pthread_cond_signal(pthread_cond_t* place) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_cond_signal)(place);
  wake(condition_of(place), 1);
  return 0;
}

UNDERSTUDY_EXPORT int pthread_cond_broadcast(pthread_cond_t* place) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_cond_broadcast)(place);
  wake(condition_of(place), INT32_MAX);
  return 0;
}

UNDERSTUDY_EXPORT int pthread_cond_wait(pthread_cond_t* place, pthread_mutex_t* mutex) {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_cond_wait)(place, mutex);
  return wait_for_signal(place, mutex, kNever);
}

UNDERSTUDY_EXPORT int pthread_cond_clockwait(pthread_cond_t* place, pthread_mutex_t* mutex, clockid_t clock,
                                             const timespec* time) {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_cond_clockwait)(place, mutex, clock, time);
  int64_t until = kNever;
  return take_end(clock, time, until) ? wait_for_signal(place, mutex, until) : EINVAL;
}

UNDERSTUDY_EXPORT int pthread_cond_timedwait(pthread_cond_t* place, pthread_mutex_t* mutex,
                                             const timespec* time) {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_cond_timedwait)(place, mutex, time);
  return pthread_cond_clockwait(place, mutex, condition_of(place).clock, time);
}

// --- semaphores ----------------------------------------------------------------------------------

UNDERSTUDY_EXPORT int sem_timedwait(sem_t* place, const timespec* time) {
  if (!is_active()) return UNDERSTUDY_REAL(sem_timedwait)(place, time);
  return wait_for_post(place, CLOCK_REALTIME, time);
}

UNDERSTUDY_EXPORT int sem_clockwait(sem_t* place, clockid_t clock, const timespec* time) {
  if (!is_active()) return UNDERSTUDY_REAL(sem_clockwait)(place, clock, time);
  return wait_for_post(place, clock, time);
}

// --- locks ---------------------------------------------------------------------------------------

UNDERSTUDY_EXPORT int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock,
                                              const timespec* time) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_mutex_clocklock)(mutex, clock, time);
  const timespec any = {0, 0};
  int64_t ignored = 0;
  if (!take_end(clock, &any, ignored)) return EINVAL;
  return try_until(clock, time, [&] {
    const int error = pthread_mutex_trylock(mutex);
    constexpr int kKindMask = 3;
    const bool is_checked = (mutex->__data.__kind & kKindMask) == PTHREAD_MUTEX_ERRORCHECK;
    return error == EBUSY && is_checked && is_own(mutex->__data.__owner) ? EDEADLK : error;
  });
}

UNDERSTUDY_EXPORT int pthread_mutex_timedlock(pthread_mutex_t* mutex, const timespec* time) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_mutex_timedlock)(mutex, time);
  return pthread_mutex_clocklock(mutex, CLOCK_REALTIME, time);
}

namespace {

int lock_until(pthread_rwlock_t* lock, int (*try_once)(pthread_rwlock_t*), clockid_t clock,
               const timespec* time) {
  int64_t ignored = 0;
  if (!take_end(clock, time, ignored)) return EINVAL;
  return try_until(clock, time, [&] {
    const int error = try_once(lock);
    return error == EBUSY && is_own(lock->__data.__cur_writer) ? EDEADLK : error;
  });
}

}  // namespace

UNDERSTUDY_EXPORT int pthread_rwlock_clockrdlock(pthread_rwlock_t* lock, clockid_t clock,
                                                 const timespec* time) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_rwlock_clockrdlock)(lock, clock, time);
  return lock_until(lock, pthread_rwlock_tryrdlock, clock, time);
}

UNDERSTUDY_EXPORT int pthread_rwlock_clockwrlock(pthread_rwlock_t* lock, clockid_t clock,
                                                 const timespec* time) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_rwlock_clockwrlock)(lock, clock, time);
  return lock_until(lock, pthread_rwlock_trywrlock, clock, time);
}

UNDERSTUDY_EXPORT int pthread_rwlock_timedrdlock(pthread_rwlock_t* lock, const timespec* time) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_rwlock_timedrdlock)(lock, time);
  return pthread_rwlock_clockrdlock(lock, CLOCK_REALTIME, time);
}

UNDERSTUDY_EXPORT int pthread_rwlock_timedwrlock(pthread_rwlock_t* lock, const timespec* time) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_rwlock_timedwrlock)(lock, time);
  return pthread_rwlock_clockwrlock(lock, CLOCK_REALTIME, time);
}

UNDERSTUDY_EXPORT int pthread_clockjoin_np(pthread_t thread, void** result, clockid_t clock,
                                           const timespec* time) {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_clockjoin_np)(thread, result, clock, time);
  return try_until(clock, time, [&] { return pthread_tryjoin_np(thread, result); });
}

UNDERSTUDY_EXPORT int pthread_timedjoin_np(pthread_t thread, void** result, const timespec* time) {
  if (!is_active()) return UNDERSTUDY_REAL(pthread_timedjoin_np)(thread, result, time);
  return pthread_clockjoin_np(thread, result, CLOCK_REALTIME, time);
}

// --- the kernel's own call, as the libraries of C++ and Rust make it ---------------------------------

namespace {

/// A timed futex wait. Returns as the system call does.
long wait_on_futex(uint32_t* word, int operation, uint32_t value, const timespec* time) {
  const int command = operation & FUTEX_CMD_MASK;
  int64_t until = kNever;
  if (command == FUTEX_WAIT) {
    until = after(ns_of(*time));
  } else {
    take_end((operation & FUTEX_CLOCK_REALTIME) != 0 ? CLOCK_REALTIME : CLOCK_MONOTONIC, time, until);
  }
  if (__atomic_load_n(word, __ATOMIC_ACQUIRE) != value) {
    errno = EAGAIN;
    return -1;
  }
  Woken woken = Woken::by_bench;
  if (now_ns() < until) {
    woken = wait_on_word(word, value, (operation & FUTEX_PRIVATE_FLAG) == 0, until);
  } else {
    check_again();
  }
  if (woken == Woken::by_descriptor) return 0;
  errno = woken == Woken::by_signal ? EINTR : ETIMEDOUT;
  return -1;
}

}  // namespace

UNDERSTUDY_EXPORT long syscall(long number, ...) noexcept {
  va_list list;
  va_start(list, number);
  long words[6];
  for (long& word : words) word = va_arg(list, long);
  va_end(list);
  if (number == SYS_futex && is_active() && words[3] != 0) {
    const int operation = static_cast<int>(words[1]);
    const int command = operation & FUTEX_CMD_MASK;
    const bool is_wait = command == FUTEX_WAIT || (command == FUTEX_WAIT_BITSET && words[5] != 0);
    if (is_wait && ns_of(*reinterpret_cast<const timespec*>(words[3])) >= 0)
      return wait_on_futex(reinterpret_cast<uint32_t*>(words[0]), operation, static_cast<uint32_t>(words[2]),
                           reinterpret_cast<const timespec*>(words[3]));
  }
  const bool leaves = (number == SYS_execve || number == SYS_execveat) && is_active();
  if (leaves) tell_leaving();
  const long result =
      UNDERSTUDY_REAL(syscall)(number, words[0], words[1], words[2], words[3], words[4], words[5]);
  if (leaves) tell_staying();
  return result;
}
