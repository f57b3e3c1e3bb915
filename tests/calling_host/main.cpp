// Makes drawn calls that exec --host-time handles, and prints what each returns: `calling_host SEED COUNT`.
// The results must not depend on whether time is simulated: the kernel and libc in real time say what is
// right.
#include "tests/calling_host/calls.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace calling_host {

clockid_t Drawer::clock() {
  // None of processor time: these clocks stand while a program waits.
  return one_of<clockid_t>({CLOCK_REALTIME, CLOCK_MONOTONIC, CLOCK_REALTIME, CLOCK_MONOTONIC,
                            CLOCK_MONOTONIC_RAW, CLOCK_REALTIME_COARSE, CLOCK_MONOTONIC_COARSE,
                            CLOCK_BOOTTIME, CLOCK_TAI, 10, 12, 99, -1});
}

timespec Drawer::length() {
  return one_of<timespec>({{0, 0},
                           {0, 1},
                           {0, 1'000'000},
                           {0, 2'000'000},
                           {-1, 0},
                           {0, -1},
                           {-1, 999'999'999},
                           {0, 1'000'000'000},
                           {INT64_MIN, 0},
                           {0, INT64_MAX},
                           {1, INT64_MIN}});
}

timeval Drawer::short_length() {
  return one_of<timeval>({{0, 0}, {0, 1'000}, {0, 2'000}, {-1, 0}, {0, -1}, {INT64_MIN, 0}});
}

timespec Drawer::end_by(clockid_t clock) {
  timespec now{};
  if (one_in(2) && clock_gettime(clock, &now) == 0) {
    const long later_ns = now.tv_nsec + below(2'000'000);
    return {now.tv_sec + later_ns / 1'000'000'000, later_ns % 1'000'000'000};
  }
  return one_of<timespec>(
      {{0, 0}, {1, 0}, {-1, 0}, {0, -1}, {5, 1'000'000'000}, {INT64_MIN, 0}, {-5, 500'000'000}});
}

int Descriptors::opened(int descriptor) {
  opened_.push_back(descriptor);
  return descriptor;
}

Descriptors::Descriptors() {
  int empty[2];
  int full[2];
  int pair[2];
  if (pipe(empty) != 0 || pipe(full) != 0 || socketpair(AF_UNIX, SOCK_STREAM, 0, pair) != 0) std::abort();
  for (const int each : {empty[0], empty[1], full[0], full[1], pair[0], pair[1]}) opened(each);
  if (write(full[1], "ready", 5) != 5 || write(pair[1], "pair", 4) != 4) std::abort();
  ready_ = full[0];
  line_ = opened(open(std::getenv("UNDERSTUDY_PORT"), O_RDWR | O_NOCTTY));
  termios settings{};
  if (tcgetattr(line_, &settings) != 0) std::abort();
  cfmakeraw(&settings);
  tcsetattr(line_, TCSANOW, &settings);
  const int quiet_epoll = opened(epoll_create1(0));
  ready_epoll_ = opened(epoll_create1(0));
  epoll_event event{EPOLLIN, {}};
  epoll_ctl(ready_epoll_, EPOLL_CTL_ADD, ready_, &event);
  epoll_ctl(quiet_epoll, EPOLL_CTL_ADD, line_, &event);
  all_ = {-1,
          99,  // closed
          INT32_MAX,
          empty[0],
          empty[1],
          full[0],
          pair[0],
          pair[1],
          line_,
          quiet_epoll,
          ready_epoll_,
          opened(open("/dev/null", O_RDWR)),
          opened(eventfd(0, EFD_NONBLOCK)),
          opened(socket(AF_INET, SOCK_STREAM, 0)),
          opened(open("/proc/self/status", O_RDONLY))};
}

Descriptors::~Descriptors() {
  for (const int each : opened_) close(each);
}

void tell(const std::string& text) { std::printf("%s\n", text.c_str()); }

void tell(const std::string& call, long result) {
  const int error = errno;
  tell(call + " -> " + std::to_string(result) +
       (result == -1 ? std::string(" ") + strerrorname_np(error) : ""));
}

void tell_error(const std::string& call, int error) {
  tell(call + " -> " + (error == 0 ? "0" : strerrorname_np(error)));
}

std::string text_of(const timespec& time) {
  return "{" + std::to_string(time.tv_sec) + ", " + std::to_string(time.tv_nsec) + "}";
}

}  // namespace calling_host

int main(int count, char** words) {
  using namespace calling_host;
  constexpr Call kCalls[] = {poll_or_select,  wait_for_epoll,    read_or_write,        use_a_socket,
                             read_a_clock,    sleep_a_little,    use_a_timerfd,        use_a_timer,
                             use_the_alarm,   wait_for_a_signal, wait_for_a_condition, wait_for_a_semaphore,
                             wait_for_a_lock, wait_for_a_thread, use_a_futex};
  if (count != 3) return 2;
  Drawer draw(static_cast<std::uint32_t>(std::atol(words[1])));
  signal(SIGALRM, SIG_IGN);
  signal(SIGPIPE, SIG_IGN);
  sigset_t blocked;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGUSR1);
  sigaddset(&blocked, SIGUSR2);
  sigprocmask(SIG_BLOCK, &blocked, nullptr);
  const Descriptors descriptors;
  const long calls = std::atol(words[2]);
  for (long i = 0; i < calls; ++i) {
    std::printf("%ld ", i);
    kCalls[draw.below(static_cast<int>(std::size(kCalls)))](draw, descriptors);
    std::fflush(stdout);
  }
  return 0;
}
