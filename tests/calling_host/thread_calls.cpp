// Waits for other threads that have an end.
#include <linux/futex.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/syscall.h>
#include <threads.h>
#include <unistd.h>

#include <functional>

#include "tests/calling_host/calls.h"

namespace calling_host {

namespace {

/// A thread that holds what is to be waited for, until this object ends.
class Holder {
 public:
  explicit Holder(
      std::function<void()> hold, std::function<void()> release = [] {})
      : hold_(std::move(hold)), release_(std::move(release)) {
    pthread_barrier_init(&held_, nullptr, 2);
    pthread_barrier_init(&over_, nullptr, 2);
    pthread_create(&thread_, nullptr, run, this);
    pthread_barrier_wait(&held_);
  }
  ~Holder() {
    pthread_barrier_wait(&over_);
    pthread_join(thread_, nullptr);
    pthread_barrier_destroy(&held_);
    pthread_barrier_destroy(&over_);
  }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;
  pthread_t thread() const { return thread_; }

 private:
  static void* run(void* self) {
    auto& holder = *static_cast<Holder*>(self);
    holder.hold_();
    pthread_barrier_wait(&holder.held_);
    pthread_barrier_wait(&holder.over_);
    holder.release_();
    return nullptr;
  }
  std::function<void()> hold_;
  std::function<void()> release_;
  pthread_barrier_t held_{};
  pthread_barrier_t over_{};
  pthread_t thread_{};
};

/// `soon` for times that depend on when the program runs.
std::string text_of_end(const timespec& end) { return end.tv_sec > 100 ? "soon" : text_of(end); }

}  // namespace

void wait_for_a_condition(Drawer& draw, const Descriptors&) {
  const clockid_t clock = draw.clock();
  pthread_condattr_t attributes;
  pthread_condattr_init(&attributes);
  tell_error("pthread_condattr_setclock(" + std::to_string(clock) + ")",
             pthread_condattr_setclock(&attributes, clock));
  clockid_t kept{};
  pthread_condattr_getclock(&attributes, &kept);
  pthread_cond_t condition;
  pthread_cond_init(&condition, &attributes);
  pthread_mutexattr_t checking;
  pthread_mutexattr_init(&checking);
  pthread_mutexattr_settype(&checking, PTHREAD_MUTEX_ERRORCHECK);
  pthread_mutex_t mutex;
  pthread_mutex_init(&mutex, &checking);
  const bool is_locked = !draw.one_in(4);
  if (is_locked) pthread_mutex_lock(&mutex);
  if (draw.one_in(2)) {
    const timespec end = draw.end_by(kept);
    tell_error("pthread_cond_timedwait(" + text_of_end(end) + ")",
               pthread_cond_timedwait(&condition, &mutex, &end));
  } else {
    const timespec end = draw.end_by(clock);
    tell_error("pthread_cond_clockwait(" + std::to_string(clock) + ", " + text_of_end(end) + ")",
               pthread_cond_clockwait(&condition, &mutex, clock, &end));
  }
  tell_error("pthread_mutex_unlock", pthread_mutex_unlock(&mutex));
  pthread_mutex_destroy(&mutex);
  pthread_cond_destroy(&condition);
}

void wait_for_a_semaphore(Drawer& draw, const Descriptors&) {
  sem_t semaphore;
  const int value = draw.below(2);
  sem_init(&semaphore, draw.below(2), static_cast<unsigned>(value));
  const std::string call = "(of " + std::to_string(value) + ", ";
  if (draw.one_in(2)) {
    const timespec end = draw.end_by(CLOCK_REALTIME);
    tell("sem_timedwait" + call + text_of_end(end) + ")",
         result_of([&] { return sem_timedwait(&semaphore, &end); }));
  } else {
    const clockid_t clock = draw.clock();
    const timespec end = draw.end_by(clock);
    tell("sem_clockwait" + call + std::to_string(clock) + ", " + text_of_end(end) + ")",
         result_of([&] { return sem_clockwait(&semaphore, clock, &end); }));
  }
  int left = 0;
  sem_getvalue(&semaphore, &left);
  tell("  " + std::to_string(left));
  sem_destroy(&semaphore);
}

namespace {

enum class Held : std::uint8_t { by_nobody, by_us, by_another };

void wait_for_a_mutex(Drawer& draw, Held held, clockid_t clock, const timespec& end,
                      const std::string& call) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  const int type =
      draw.one_of({int{PTHREAD_MUTEX_NORMAL}, int{PTHREAD_MUTEX_RECURSIVE}, int{PTHREAD_MUTEX_ERRORCHECK}});
  pthread_mutexattr_settype(&attributes, type);
  pthread_mutex_t mutex;
  pthread_mutex_init(&mutex, &attributes);
  if (held == Held::by_us) pthread_mutex_lock(&mutex);
  const auto wait = [&] {
    switch (draw.below(3)) {
      case 0:
        return tell_error("pthread_mutex_timedlock " + std::to_string(type) + call,
                          pthread_mutex_timedlock(&mutex, &end));
      case 1:
        return tell_error("pthread_mutex_clocklock " + std::to_string(type) + call,
                          pthread_mutex_clocklock(&mutex, clock, &end));
      default:
        return tell_error("mtx_timedlock " + std::to_string(type) + call,
                          mtx_timedlock(reinterpret_cast<mtx_t*>(&mutex), &end));
    }
  };
  if (held != Held::by_another) return wait();
  const Holder holder([&] { pthread_mutex_lock(&mutex); }, [&] { pthread_mutex_unlock(&mutex); });
  wait();
}

void wait_for_a_rwlock(Drawer& draw, Held held, clockid_t clock, const timespec& end,
                       const std::string& call) {
  pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;
  const bool is_written = draw.one_in(2);
  const auto hold = [&] { is_written ? pthread_rwlock_wrlock(&lock) : pthread_rwlock_rdlock(&lock); };
  if (held == Held::by_us) hold();
  const std::string what = std::string(is_written ? " written" : " read") + call;
  const auto wait = [&] {
    switch (draw.below(4)) {
      case 0: return tell_error("pthread_rwlock_timedrdlock" + what, pthread_rwlock_timedrdlock(&lock, &end));
      case 1: return tell_error("pthread_rwlock_timedwrlock" + what, pthread_rwlock_timedwrlock(&lock, &end));
      case 2:
        return tell_error("pthread_rwlock_clockrdlock" + what,
                          pthread_rwlock_clockrdlock(&lock, clock, &end));
      default:
        return tell_error("pthread_rwlock_clockwrlock" + what,
                          pthread_rwlock_clockwrlock(&lock, clock, &end));
    }
  };
  if (held != Held::by_another) return wait();
  const Holder holder(hold, [&] { pthread_rwlock_unlock(&lock); });
  wait();
}

}  // namespace

void wait_for_a_lock(Drawer& draw, const Descriptors&) {
  const auto held = draw.one_of({Held::by_nobody, Held::by_us, Held::by_another});
  const clockid_t clock = draw.one_in(2) ? CLOCK_REALTIME : draw.clock();
  const timespec end = draw.end_by(clock);
  const std::string call = "(held " + std::to_string(static_cast<int>(held)) + ", " + std::to_string(clock) +
                           ", " + text_of_end(end) + ")";
  return draw.one_in(2) ? wait_for_a_mutex(draw, held, clock, end, call)
                        : wait_for_a_rwlock(draw, held, clock, end, call);
}

/// libc itself tries again without end if the end is not a time, or the clock not one of two.
void wait_for_a_thread(Drawer& draw, const Descriptors&) {
  const Holder holder([] {});
  const clockid_t clock = draw.one_of<clockid_t>({CLOCK_REALTIME, CLOCK_MONOTONIC});
  const auto end_by = [&](clockid_t of) {
    timespec end = draw.end_by(of);
    if (end.tv_nsec < 0 || end.tv_nsec >= 1'000'000'000) end = {1, 0};
    return end;
  };
  if (draw.one_in(2)) {
    const timespec end = end_by(CLOCK_REALTIME);
    tell_error("pthread_timedjoin_np(" + text_of_end(end) + ")",
               pthread_timedjoin_np(holder.thread(), nullptr, &end));
  } else {
    const timespec end = end_by(clock);
    tell_error("pthread_clockjoin_np(" + std::to_string(clock) + ", " + text_of_end(end) + ")",
               pthread_clockjoin_np(holder.thread(), nullptr, clock, &end));
  }
}

void use_a_futex(Drawer& draw, const Descriptors&) {
  std::uint32_t word = 7;
  const std::uint32_t expected = draw.one_of({7U, 7U, 8U});
  const int operation =
      draw.one_of({FUTEX_WAIT, FUTEX_WAIT_PRIVATE, FUTEX_WAIT_BITSET, FUTEX_WAIT_BITSET_PRIVATE,
                   FUTEX_WAIT_BITSET_PRIVATE | FUTEX_CLOCK_REALTIME});
  const std::uint32_t bits = draw.one_of({FUTEX_BITSET_MATCH_ANY, 0U});
  const bool is_absolute = (operation & FUTEX_CMD_MASK) == FUTEX_WAIT_BITSET;
  const timespec time =
      is_absolute ? draw.end_by((operation & FUTEX_CLOCK_REALTIME) != 0 ? CLOCK_REALTIME : CLOCK_MONOTONIC)
                  : draw.length();
  tell("futex(" + std::to_string(operation) + ", " + std::to_string(expected) + ", " + text_of_end(time) +
           ", " + std::to_string(bits) + ")",
       result_of([&] { return syscall(SYS_futex, &word, operation, expected, &time, nullptr, bits); }));
}

}  // namespace calling_host
