// Clocks, sleeps, timers and signals.
#include <sys/timerfd.h>
#include <threads.h>
#include <unistd.h>

#include <climits>

#include "tests/calling_host/calls.h"

namespace calling_host {

namespace {

/// Far enough that it does not expire during the call, or over, or not a setting.
itimerspec setting(Drawer& draw) {
  const auto part = [&] {
    return draw.one_of<timespec>(
        {{0, 0}, {1'000, 0}, {1'000, 999'999'999}, {-1, 0}, {1'000, -1}, {1'000, 1'000'000'000}});
  };
  const timespec interval = part();
  return {interval, part()};
}

std::string text_of_setting(const itimerspec& spec) {
  return text_of(spec.it_value) + " " + text_of(spec.it_interval);
}

/// Its rest, by the hundred seconds: real time has gone on meanwhile.
std::string rest_of(const itimerspec& spec) {
  return "  rest " + std::to_string((spec.it_value.tv_sec + 50) / 100) + " " + text_of(spec.it_interval);
}

}  // namespace

void read_a_clock(Drawer& draw, const Descriptors&) {
  timespec time{};
  const clockid_t clock = draw.one_in(3)
                              ? draw.one_of<clockid_t>({CLOCK_PROCESS_CPUTIME_ID, CLOCK_THREAD_CPUTIME_ID})
                              : draw.clock();
  const std::string call = "(" + std::to_string(clock) + ")";
  switch (draw.below(3)) {
    case 0: return tell("clock_gettime" + call, result_of([&] { return clock_gettime(clock, &time); }));
    case 1: return tell("clock_getres" + call, result_of([&] { return clock_getres(clock, &time); }));
    default: return tell("timespec_get" + call, result_of([&] { return timespec_get(&time, clock); }));
  }
}

void sleep_a_little(Drawer& draw, const Descriptors&) {
  const timespec length = draw.length();
  switch (draw.below(5)) {
    case 0:
      return tell("nanosleep" + text_of(length), result_of([&] { return nanosleep(&length, nullptr); }));
    case 1: {
      const clockid_t clock = draw.clock();
      return tell_error("clock_nanosleep(" + std::to_string(clock) + ", " + text_of(length) + ")",
                        clock_nanosleep(clock, draw.one_of({0, 2, 4}), &length, nullptr));
    }
    case 2: {
      const clockid_t clock = draw.clock();
      const timespec end = draw.end_by(clock);
      const bool is_past = end.tv_sec < 100;
      return tell_error(
          "clock_nanosleep(" + std::to_string(clock) + ", until " + (is_past ? text_of(end) : "soon") + ")",
          clock_nanosleep(clock, TIMER_ABSTIME, &end, nullptr));
    }
    case 3: return tell("usleep", result_of([&] { return usleep(draw.one_of<useconds_t>({0, 1, 1'500})); }));
    default:
      return tell("thrd_sleep" + text_of(length), result_of([&] { return thrd_sleep(&length, nullptr); }));
  }
}

void use_a_timerfd(Drawer& draw, const Descriptors& descriptors) {
  const clockid_t clock = draw.clock();
  const int flags =
      draw.one_of<int>({0, TFD_NONBLOCK, TFD_CLOEXEC, TFD_NONBLOCK | TFD_CLOEXEC, 1, -1, 1 << 30});
  const int timer = static_cast<int>(result_of([&] { return timerfd_create(clock, flags); }));
  tell("timerfd_create(" + std::to_string(clock) + ", " + std::to_string(flags) + ")", timer);
  const int used = draw.one_in(4) ? descriptors.any(draw) : timer;
  for (int step = 0; step < 3; ++step) {
    const itimerspec spec = setting(draw);
    itimerspec before{};
    const int mode = draw.one_of<int>({0, 0, TFD_TIMER_ABSTIME, 4, -1});
    const long result = result_of([&] { return timerfd_settime(used, mode, &spec, &before); });
    tell("timerfd_settime(" + std::to_string(used) + ", " + std::to_string(mode) + ", " +
             text_of_setting(spec) + ")",
         result);
    const bool is_absolute = mode != 0;
    if (result == 0 && !is_absolute) tell(rest_of(before));
    const long got = result_of([&] { return timerfd_gettime(used, &before); });
    tell("timerfd_gettime", got);
    if (got == 0 && !is_absolute) tell(rest_of(before));
    if (is_absolute) break;  // it is over, or not, by the machine's own time
  }
  std::uint64_t count = 0;
  tell("read of 4", result_of([&] { return read(timer, &count, 4); }));
  const itimerspec soon{{0, 0}, {0, 1'000'000}};
  if (timerfd_settime(timer, 0, &soon, nullptr) == 0 && (flags & TFD_NONBLOCK) == 0) {
    tell("read", result_of([&] { return read(timer, &count, sizeof count); }));
    tell("  " + std::to_string(count));
  }
  close(timer);
}

void use_a_timer(Drawer& draw, const Descriptors&) {
  const clockid_t clock = draw.clock();
  sigevent event{};
  event.sigev_notify = draw.one_of({int{SIGEV_SIGNAL}, int{SIGEV_SIGNAL}, 77, -1});
  event.sigev_signo = draw.one_of({SIGUSR1, SIGUSR1, 0, -1, 65, 1'000});
  sigevent* const given = draw.one_in(4) ? nullptr : &event;
  timer_t timer{};
  const std::string what = given == nullptr
                               ? "none"
                               : std::to_string(event.sigev_notify) + " " + std::to_string(event.sigev_signo);
  const long made = result_of([&] { return timer_create(clock, given, &timer); });
  tell("timer_create(" + std::to_string(clock) + ", " + what + ")", made);
  if (made != 0) return;
  for (int step = 0; step < 3; ++step) {
    const itimerspec spec = setting(draw);
    itimerspec before{};
    const int mode = draw.one_of({0, 0, 0, 2, 4});
    const long result = result_of([&] { return timer_settime(timer, mode, &spec, &before); });
    tell("timer_settime(" + std::to_string(mode) + ", " + text_of_setting(spec) + ")", result);
    if (result == 0) tell(rest_of(before));
    tell("timer_gettime", result_of([&] { return timer_gettime(timer, &before); }));
    tell(rest_of(before));
  }
  tell("timer_getoverrun", result_of([&] { return timer_getoverrun(timer); }));
  tell("timer_delete", result_of([&] { return timer_delete(timer); }));
}

void use_the_alarm(Drawer& draw, const Descriptors&) {
  const auto part = [&] {
    return draw.one_of<timeval>(
        {{0, 0}, {1'000, 0}, {1'000, 999'999}, {1'000, 1'000'000}, {-1, 0}, {1'000, -1}});
  };
  const auto which = draw.one_of<__itimer_which_t>(
      {ITIMER_REAL, ITIMER_REAL, ITIMER_REAL, static_cast<__itimer_which_t>(77)});
  for (int step = 0; step < 3; ++step) {
    if (draw.one_in(3)) {
      tell("alarm", result_of([&] { return (alarm(draw.one_of({0U, 1'000U, 5'000U})) + 50) / 100; }));
      continue;
    }
    const timeval interval = part();
    const itimerval value{interval, part()};
    itimerval before{};
    const std::string call = std::to_string(which) + ", " + std::to_string(value.it_value.tv_sec) + "." +
                             std::to_string(value.it_value.tv_usec) + " " + std::to_string(interval.tv_sec) +
                             "." + std::to_string(interval.tv_usec);
    tell("setitimer(" + call + ")", result_of([&] { return setitimer(which, &value, &before); }));
    tell("  " + std::to_string((before.it_value.tv_sec + 50) / 100) + " " +
         std::to_string(before.it_interval.tv_usec));
    tell("getitimer", result_of([&] { return getitimer(which, &before); }));
    tell("  " + std::to_string((before.it_value.tv_sec + 50) / 100) + " " +
         std::to_string(before.it_interval.tv_usec));
  }
  const itimerval none{};
  setitimer(ITIMER_REAL, &none, nullptr);
}

void wait_for_a_signal(Drawer& draw, const Descriptors&) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR2);
  if (draw.one_in(3)) raise(SIGUSR2);
  const timespec length = draw.length();
  tell("sigtimedwait" + text_of(length), result_of([&] { return sigtimedwait(&set, nullptr, &length); }));
  const timespec none{0, 0};
  while (sigtimedwait(&set, nullptr, &none) > 0) {
  }
}

}  // namespace calling_host
