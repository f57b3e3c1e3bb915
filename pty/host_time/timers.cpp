// Timers of a host in simulated time. The bench runs them: it sends the signals, and counts in the
// descriptors. These are eventfds here, which are read like timers.
#include <errno.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

namespace {

/// When a timer expires next, and the interval after that. next_ns is 0 if it is not set.
struct Setting {
  int64_t next_ns;
  int64_t interval_ns;
};

Setting present(const Setting& setting) {
  const int64_t now = now_ns();
  if (setting.next_ns == 0 || now < setting.next_ns) return setting;
  if (setting.interval_ns == 0) return {0, 0};
  const int64_t missed = (now - setting.next_ns) / setting.interval_ns + 1;
  return {setting.next_ns + missed * setting.interval_ns, setting.interval_ns};
}

itimerspec spec_of(const Setting& setting) {
  const Setting current = present(setting);
  itimerspec spec = {};
  if (current.next_ns != 0) spec.it_value = time_of(current.next_ns - now_ns());
  spec.it_interval = time_of(setting.interval_ns);
  return spec;
}

/// Returns false if the times are not valid.
bool take_setting(const itimerspec& spec, bool is_absolute, clockid_t clock, Setting& setting) {
  const int64_t value = ns_of(spec.it_value);
  const int64_t interval = ns_of(spec.it_interval);
  if (value < 0 || interval < 0) return false;
  setting = {0, interval};
  if (value == 0) return true;
  const int64_t at = is_absolute ? value - clock_begin_ns(clock) : after(value);
  setting.next_ns = at > now_ns() ? at : now_ns() + 1;  // a time in the past expires at once
  return true;
}

Message message_of(uint32_t number, const Setting& setting) {
  Message message = {};
  message.what = MessageKind::timer;
  message.sequence = number;
  message.until_ns = setting.next_ns == 0 ? kNever : setting.next_ns;
  message.interval_ns = setting.interval_ns;
  return message;
}

// --- timers as descriptors -----------------------------------------------------------------------

constexpr int kMaxDescriptors = 1024;
constexpr uint32_t kFirstDescriptor = 1U << 16;  // timers that send signals have lower numbers

struct DescriptorTimer {
  bool is_timer;
  clockid_t clock;
  Setting setting;
};
DescriptorTimer descriptors[kMaxDescriptors];

bool is_eventfd(int descriptor) {
  char path[32] = "/proc/self/fd/";
  char digits[12];
  int count = 0;
  for (int rest = descriptor; rest > 0 || count == 0; rest /= 10)
    digits[count++] = static_cast<char>('0' + rest % 10);
  char* place = path + strlen(path);
  while (count > 0) *place++ = digits[--count];
  *place = '\0';
  char target[64];
  const int error = errno;
  const ssize_t size = readlink(path, target, sizeof target - 1);
  errno = error;
  if (size < 0) return false;
  target[size] = '\0';
  return strcmp(target, "anon_inode:[eventfd]") == 0;
}

DescriptorTimer* timer_of(int descriptor) {
  if (descriptor < 0 || descriptor >= kMaxDescriptors || !descriptors[descriptor].is_timer) return nullptr;
  if (is_eventfd(descriptor)) return &descriptors[descriptor];
  descriptors[descriptor].is_timer = false;  // it was closed, and another file has its number
  return nullptr;
}

}  // namespace

bool understudy::host_time::is_timer(int descriptor) { return timer_of(descriptor) != nullptr; }

/// Passes invalid arguments to the kernel, which reports them.
UNDERSTUDY_EXPORT int timerfd_create(clockid_t clock, int flags) noexcept {
  const bool is_good =
      is_for_waits(clock) && clock != CLOCK_TAI && (flags & ~(TFD_NONBLOCK | TFD_CLOEXEC)) == 0;
  if (!is_active() || !is_good) return UNDERSTUDY_REAL(timerfd_create)(clock, flags);
  static_assert(int{TFD_NONBLOCK} == int{EFD_NONBLOCK} && int{TFD_CLOEXEC} == int{EFD_CLOEXEC});
  const int descriptor = eventfd(0, flags);
  if (descriptor >= kMaxDescriptors) {
    close(descriptor);
    errno = EMFILE;
    return -1;
  }
  if (descriptor >= 0) descriptors[descriptor] = {true, clock, {0, 0}};
  return descriptor;
}

UNDERSTUDY_EXPORT int timerfd_settime(int descriptor, int flags, const itimerspec* spec,
                                      itimerspec* before) noexcept {
  DescriptorTimer* const timer = is_active() ? timer_of(descriptor) : nullptr;
  if (timer == nullptr || spec == nullptr)
    return UNDERSTUDY_REAL(timerfd_settime)(descriptor, flags, spec, before);
  Setting setting;
  if ((flags & ~(TFD_TIMER_ABSTIME | TFD_TIMER_CANCEL_ON_SET)) != 0 ||
      !take_setting(*spec, (flags & TFD_TIMER_ABSTIME) != 0, timer->clock, setting)) {
    errno = EINVAL;
    return -1;
  }
  if (before != nullptr) *before = spec_of(timer->setting);
  timer->setting = setting;
  uint64_t ignored;  // expirations of the previous setting
  const int error = errno;
  pollfd entry = {descriptor, POLLIN, 0};
  if (UNDERSTUDY_REAL(poll)(&entry, 1, 0) == 1) [[maybe_unused]]
    const ssize_t size = UNDERSTUDY_REAL(read)(descriptor, &ignored, sizeof ignored);
  tell_timer(message_of(kFirstDescriptor + static_cast<uint32_t>(descriptor), setting), descriptor);
  errno = error;
  return 0;
}

UNDERSTUDY_EXPORT int timerfd_gettime(int descriptor, itimerspec* spec) noexcept {
  const DescriptorTimer* const timer = is_active() ? timer_of(descriptor) : nullptr;
  if (timer == nullptr) return UNDERSTUDY_REAL(timerfd_gettime)(descriptor, spec);
  *spec = spec_of(timer->setting);
  return 0;
}

// --- the timer that each process has -------------------------------------------------------------

namespace {

Setting alarm_setting;

/// Converts a time. Returns false if it is not valid.
bool take_time(const timeval& given, timespec& time) {
  if (given.tv_usec < 0 || given.tv_usec >= 1'000'000) return false;
  time = {given.tv_sec, given.tv_usec * 1'000};
  return true;
}

void set_alarm(const Setting& setting) {
  alarm_setting = setting;
  Message message = message_of(0, setting);
  message.signal = SIGALRM;
  tell_timer(message, -1);
}

}  // namespace

void understudy::host_time::forget_timers() { alarm_setting = {0, 0}; }

UNDERSTUDY_EXPORT int setitimer(__itimer_which_t which, const itimerval* value, itimerval* before) noexcept {
  if (!is_active() || which != ITIMER_REAL) return UNDERSTUDY_REAL(setitimer)(which, value, before);
  itimerspec spec = {};
  const bool is_good = value == nullptr || (take_time(value->it_value, spec.it_value) &&
                                            take_time(value->it_interval, spec.it_interval));
  Setting setting;
  if (!is_good || !take_setting(spec, false, CLOCK_MONOTONIC, setting)) {
    errno = EINVAL;
    return -1;
  }
  if (setting.next_ns == 0) setting.interval_ns = 0;
  if (before != nullptr) getitimer(which, before);
  set_alarm(setting);
  return 0;
}

UNDERSTUDY_EXPORT int getitimer(__itimer_which_t which, itimerval* value) noexcept {
  if (!is_active() || which != ITIMER_REAL) return UNDERSTUDY_REAL(getitimer)(which, value);
  const itimerspec spec = spec_of(alarm_setting);
  *value = {{spec.it_interval.tv_sec, spec.it_interval.tv_nsec / 1'000},
            {spec.it_value.tv_sec, spec.it_value.tv_nsec / 1'000}};
  return 0;
}

UNDERSTUDY_EXPORT unsigned alarm(unsigned seconds) noexcept {
  if (!is_active()) return UNDERSTUDY_REAL(alarm)(seconds);
  const timespec rest = spec_of(alarm_setting).it_value;
  set_alarm(seconds == 0 ? Setting{0, 0} : Setting{after(int64_t{seconds} * kBillion), 0});
  const unsigned whole = static_cast<unsigned>(rest.tv_sec);
  return whole == 0 && rest.tv_nsec > 0 ? 1 : whole + (rest.tv_nsec >= kBillion / 2 ? 1 : 0);
}

// --- timed waits for signals -----------------------------------------------------------------------

UNDERSTUDY_EXPORT int sigtimedwait(const sigset_t* set, siginfo_t* info, const timespec* time) {
  if (!is_active() || time == nullptr) return UNDERSTUDY_REAL(sigtimedwait)(set, info, time);
  const int64_t length = ns_of(*time);
  const timespec nothing = {0, 0};
  if (length < 0) {
    errno = EINVAL;
    return -1;
  }
  const int64_t until = after(length);
  const int pending = signalfd(-1, set, SFD_CLOEXEC);  // readable while one of them is pending
  pollfd entry = {pending, POLLIN, 0};
  int result = -1;
  while (true) {
    result = UNDERSTUDY_REAL(sigtimedwait)(set, info, &nothing);
    if (result >= 0 || errno != EAGAIN) break;
    if (now_ns() >= until) {
      if (length == 0) check_again();
      break;
    }
    Wait wait;
    wait.until_ns = until;
    wait.others = &entry;
    wait.other_count = pending >= 0 ? 1 : 0;
    if (wait_for(wait) != Woken::by_signal) continue;
    errno = EINTR;
    break;
  }
  const int error = errno;
  if (pending >= 0) close(pending);
  errno = error;
  return result;
}

// --- timers by timer_create ----------------------------------------------------------------------

namespace {

constexpr uint32_t kMaxTimers = 128;
constexpr uintptr_t kMark = 0x5a000000;  // distinguishes our timers from libc's

struct SignalTimer {
  bool is_used;
  clockid_t clock;
  Setting setting;
  sigevent event;
};
SignalTimer timers[kMaxTimers];

SignalTimer* timer_of(timer_t timer) {
  const uintptr_t number = reinterpret_cast<uintptr_t>(timer) - kMark;
  return number < kMaxTimers && timers[number].is_used ? &timers[number] : nullptr;
}

uint32_t number_of(const SignalTimer& timer) { return static_cast<uint32_t>(&timer - timers) + 1; }

void tell(const SignalTimer& timer) {
  Message message = message_of(number_of(timer), timer.setting);
  if (timer.event.sigev_notify != SIGEV_NONE) message.signal = timer.event.sigev_signo;
  message.value = reinterpret_cast<intptr_t>(timer.event.sigev_value.sival_ptr);
  if (timer.event.sigev_notify == SIGEV_THREAD_ID) message.target = timer.event._sigev_un._tid;
  if (message.signal == 0) message.until_ns = kNever;
  tell_timer(message, -1);
}

}  // namespace

namespace {

/// Returns false for timers that start a thread at each expiry, which are left to libc, and for invalid
/// events, which are left to the kernel.
bool is_simulated(const sigevent& event) {
  if (event.sigev_notify == SIGEV_NONE) return true;
  const bool is_signal = event.sigev_notify == SIGEV_SIGNAL || event.sigev_notify == SIGEV_THREAD_ID;
  return is_signal && event.sigev_signo > 0 && event.sigev_signo <= SIGRTMAX;
}

}  // namespace

UNDERSTUDY_EXPORT int timer_create(clockid_t clock, sigevent* event, timer_t* place) noexcept {
  const bool is_ours = is_active() && is_for_waits(clock) && (event == nullptr || is_simulated(*event));
  if (!is_ours) return UNDERSTUDY_REAL(timer_create)(clock, event, place);
  for (uint32_t i = 0; i < kMaxTimers; ++i) {
    if (__atomic_test_and_set(&timers[i].is_used, __ATOMIC_ACQ_REL)) continue;
    *place = reinterpret_cast<timer_t>(kMark + i);
    timers[i].clock = clock;
    timers[i].setting = {0, 0};
    timers[i].event = {};
    if (event != nullptr) {
      timers[i].event = *event;
    } else {
      timers[i].event.sigev_notify = SIGEV_SIGNAL;
      timers[i].event.sigev_signo = SIGALRM;
      timers[i].event.sigev_value.sival_ptr = *place;
    }
    return 0;
  }
  errno = EAGAIN;
  return -1;
}

UNDERSTUDY_EXPORT int timer_settime(timer_t place, int flags, const itimerspec* spec,
                                    itimerspec* before) noexcept {
  SignalTimer* const timer = is_active() ? timer_of(place) : nullptr;
  if (timer == nullptr) return UNDERSTUDY_REAL(timer_settime)(place, flags, spec, before);
  Setting setting;
  if (spec == nullptr || !take_setting(*spec, (flags & TIMER_ABSTIME) != 0, timer->clock, setting)) {
    errno = EINVAL;
    return -1;
  }
  if (setting.next_ns == 0) setting.interval_ns = 0;
  if (before != nullptr) *before = spec_of(timer->setting);
  timer->setting = setting;
  tell(*timer);
  return 0;
}

UNDERSTUDY_EXPORT int timer_gettime(timer_t place, itimerspec* spec) noexcept {
  const SignalTimer* const timer = is_active() ? timer_of(place) : nullptr;
  if (timer == nullptr) return UNDERSTUDY_REAL(timer_gettime)(place, spec);
  *spec = spec_of(timer->setting);
  return 0;
}

UNDERSTUDY_EXPORT int timer_getoverrun(timer_t place) noexcept {
  const bool is_ours = is_active() && timer_of(place) != nullptr;
  return is_ours ? 0 : UNDERSTUDY_REAL(timer_getoverrun)(place);
}

UNDERSTUDY_EXPORT int timer_delete(timer_t place) noexcept {
  SignalTimer* const timer = is_active() ? timer_of(place) : nullptr;
  if (timer == nullptr) return UNDERSTUDY_REAL(timer_delete)(place);
  timer->setting = {0, 0};
  tell(*timer);
  timer->is_used = false;
  return 0;
}
