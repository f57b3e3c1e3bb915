// A host of three threads that waits in every way that ends. For each it prints how long it took, by its own
// clock, and whether it ended as it should.
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <termios.h>
#include <threads.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <future>
#include <mutex>
#include <semaphore>
#include <thread>

namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

void tell(const char* name, const std::function<bool()>& is_as_it_should_be) {
  const auto begin = Clock::now();
  const bool is_good = is_as_it_should_be();
  const auto length = std::chrono::duration_cast<milliseconds>(Clock::now() - begin).count();
  std::printf("%s %lld %s\n", name, static_cast<long long>(length), is_good ? "good" : "WRONG");
}

timespec in(clockid_t clock, int seconds) {
  timespec time{};
  clock_gettime(clock, &time);
  time.tv_sec += seconds;
  return time;
}

std::atomic<int> alarms = 0;
void on_alarm(int) { ++alarms; }

void install(int signal_number, int flags) {
  struct sigaction action {};
  action.sa_handler = on_alarm;
  action.sa_flags = flags;
  sigaction(signal_number, &action, nullptr);
}

void wait_for_each_other() {
  std::mutex mutex;
  std::condition_variable condition;
  bool is_ready = false;
  tell("condition-timeout", [&] {
    std::unique_lock lock(mutex);
    return !condition.wait_for(lock, milliseconds(2'500), [&] { return is_ready; });
  });
  std::thread other([&] {
    std::this_thread::sleep_for(milliseconds(700));
    const std::lock_guard lock(mutex);
    is_ready = true;
    condition.notify_all();
  });
  tell("condition-signal", [&] {
    std::unique_lock lock(mutex);
    return condition.wait_for(lock, milliseconds(2'500), [&] { return is_ready; });
  });
  other.join();
  pthread_cond_t by_date = PTHREAD_COND_INITIALIZER;
  pthread_mutex_t its_mutex = PTHREAD_MUTEX_INITIALIZER;
  tell("condition-by-date", [&] {
    const timespec end = in(CLOCK_REALTIME, 3);
    pthread_mutex_lock(&its_mutex);
    const int error = pthread_cond_timedwait(&by_date, &its_mutex, &end);
    pthread_mutex_unlock(&its_mutex);
    return error == ETIMEDOUT;
  });
  sem_t semaphore;
  sem_init(&semaphore, 0, 0);
  tell("semaphore-timeout", [&] {
    const timespec end = in(CLOCK_REALTIME, 4);
    return sem_timedwait(&semaphore, &end) == -1 && errno == ETIMEDOUT;
  });
  std::thread poster([&] {
    std::this_thread::sleep_for(milliseconds(300));
    sem_post(&semaphore);
  });
  tell("semaphore-post", [&] {
    const timespec end = in(CLOCK_REALTIME, 4);
    return sem_timedwait(&semaphore, &end) == 0;
  });
  poster.join();
  std::timed_mutex locked;
  locked.lock();
  tell("mutex-timeout", [&] {
    return std::async(std::launch::async, [&] { return !locked.try_lock_for(milliseconds(1'500)); }).get();
  });
  std::counting_semaphore<4> counting(0);
  tell("counting-timeout", [&] { return !counting.try_acquire_for(milliseconds(1'200)); });
  std::promise<int> promise;
  std::thread keeper([&] {
    std::this_thread::sleep_for(milliseconds(900));
    promise.set_value(7);
  });
  tell("future", [&] {
    std::future<int> future = promise.get_future();
    return future.wait_for(milliseconds(400)) == std::future_status::timeout &&
           future.wait_for(milliseconds(5'000)) == std::future_status::ready && future.get() == 7;
  });
  keeper.join();
}

void wait_for_timers() {
  const int timer = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC);
  itimerspec setting{{0, 250'000'000}, {1, 0}};
  std::uint64_t count = 0;
  timerfd_settime(timer, 0, &setting, nullptr);
  tell("timerfd-read", [&] { return read(timer, &count, sizeof count) == 8 && count == 1; });
  tell("timerfd-late", [&] {
    std::this_thread::sleep_for(milliseconds(1'100));
    return read(timer, &count, sizeof count) == 8 && count == 4;
  });
  const int epoll = epoll_create1(EPOLL_CLOEXEC);
  epoll_event event{EPOLLIN, {}};
  epoll_ctl(epoll, EPOLL_CTL_ADD, timer, &event);
  tell("timerfd-epoll", [&] { return epoll_wait(epoll, &event, 1, 5'000) == 1; });
  itimerspec rest{};
  timerfd_gettime(timer, &rest);
  tell("timerfd-rest", [&] { return rest.it_value.tv_nsec == 250'000'000; });
  close(timer);
  close(epoll);

  install(SIGALRM, 0);
  alarm(2);
  tell("alarm-ends-sleep", [] { return sleep(10) == 8 && alarms == 1; });
  itimerval fast{{0, 300'000}, {0, 300'000}};
  setitimer(ITIMER_REAL, &fast, nullptr);
  tell("itimer-three", [] {
    while (alarms < 4) pause();
    return true;
  });
  const itimerval none{};
  setitimer(ITIMER_REAL, &none, nullptr);
  tell("no-alarm-any-more", [] { return sleep(1) == 0 && alarms == 4; });

  install(SIGUSR1, SA_RESTART);
  sigevent notice{};
  notice.sigev_notify = SIGEV_SIGNAL;
  notice.sigev_signo = SIGUSR1;
  timer_t posix{};
  timer_create(CLOCK_REALTIME, &notice, &posix);
  setting = {{0, 0}, {1, 500'000'000}};
  timer_settime(posix, 0, &setting, nullptr);
  tell("timer-ends-sleep", [] { return sleep(10) == 8 && alarms == 5; });
  timer_delete(posix);
  tell("signal-timeout", [] {
    sigset_t set{};
    sigaddset(&set, SIGUSR2);
    const timespec length{0, 500'000'000};
    return sigtimedwait(&set, nullptr, &length) == -1 && errno == EAGAIN;
  });
  tell("c11-timeout", [] {
    cnd_t condition;
    mtx_t mutex;
    cnd_init(&condition);
    mtx_init(&mutex, mtx_timed);
    mtx_lock(&mutex);
    const timespec end = in(CLOCK_REALTIME, 1);
    return cnd_timedwait(&condition, &mutex, &end) == thrd_timedout &&
           mtx_timedlock(&mutex, &end) == thrd_timedout;
  });
}

/// Opens the port so that a read waits for the bytes or the tenths of a second.
int open_port(cc_t bytes, cc_t tenths) {
  const int port = open(std::getenv("UNDERSTUDY_PORT"), O_RDWR | O_NOCTTY);
  termios settings{};
  tcgetattr(port, &settings);
  cfmakeraw(&settings);
  cfsetspeed(&settings, B19200);
  settings.c_cc[VMIN] = bytes;
  settings.c_cc[VTIME] = tenths;
  tcsetattr(port, TCSANOW, &settings);
  return port;
}

/// The port is set as a host does that waits until everything is sent, and takes more than the kernel keeps.
void wait_for_the_line() {
  const int port = open_port(1, 0);
  termios settings{};
  tcgetattr(port, &settings);
  static char nothing[10'000];
  tell("drained-by-tcsetattr",
       [&] { return write(port, nothing, 192) == 192 && tcsetattr(port, TCSADRAIN, &settings) == 0; });
  tell("long-write",
       [&] { return write(port, nothing, sizeof nothing) == sizeof nothing && tcdrain(port) == 0; });
  close(port);
}

/// A signal ends these waits, as signal(7) says: those of descriptors and sleeps always, reads and semaphores
/// without SA_RESTART, conditions never.
void wait_until_interrupted() {
  const int port = open_port(7, 0);
  const auto tell_interrupted = [](const char* name, const std::function<bool()>& wait) {
    alarm(1);
    tell(name, wait);
  };
  install(SIGALRM, SA_RESTART);
  pollfd entry{port, POLLIN, 0};
  fd_set set;
  FD_ZERO(&set);
  FD_SET(port, &set);
  timeval length{5, 0};
  tell_interrupted("select-interrupted", [&] {
    return select(port + 1, &set, nullptr, nullptr, &length) == -1 && errno == EINTR && length.tv_sec == 4;
  });
  tell_interrupted("poll-interrupted", [&] { return poll(&entry, 1, 5'000) == -1 && errno == EINTR; });
  const int epoll = epoll_create1(EPOLL_CLOEXEC);
  epoll_event event{EPOLLIN, {}};
  epoll_ctl(epoll, EPOLL_CTL_ADD, port, &event);
  tell_interrupted("epoll-interrupted",
                   [&] { return epoll_wait(epoll, &event, 1, 5'000) == -1 && errno == EINTR; });
  close(epoll);
  tell_interrupted("nanosleep-interrupted", [] {
    const timespec asked{5, 0};
    timespec rest{};
    return nanosleep(&asked, &rest) == -1 && errno == EINTR && rest.tv_sec == 4;
  });
  pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  tell_interrupted("condition-not-interrupted", [&] {
    const timespec end = in(CLOCK_REALTIME, 3);
    pthread_mutex_lock(&mutex);
    const int error = pthread_cond_timedwait(&condition, &mutex, &end);
    pthread_mutex_unlock(&mutex);
    return error == ETIMEDOUT;
  });
  std::array<unsigned char, 7> reply{};
  std::thread asking([&] {
    std::this_thread::sleep_for(milliseconds(2'000));
    constexpr std::array<unsigned char, 8> kRequest{1, 3, 0, 1, 0, 1, 0xD5, 0xCA};
    if (write(port, kRequest.data(), kRequest.size()) != 8) std::abort();
  });
  tell_interrupted("read-restarted", [&] { return read(port, reply.data(), reply.size()) == 7; });
  asking.join();
  install(SIGALRM, 0);
  sem_t semaphore;
  sem_init(&semaphore, 0, 0);
  tell_interrupted("semaphore-interrupted", [&] {
    const timespec end = in(CLOCK_REALTIME, 4);
    return sem_timedwait(&semaphore, &end) == -1 && errno == EINTR;
  });
  tell_interrupted("read-interrupted",
                   [&] { return read(port, reply.data(), reply.size()) == -1 && errno == EINTR; });
  close(port);
}

/// A port that another thread closes ends no wait, as on Linux. Only poll notices it, when it looks again.
void wait_for_a_closed_port() {
  const auto tell_closed = [](const char* name, const std::function<bool(int)>& wait) {
    const int port = open_port(0, 20);
    std::thread closing([&] {
      std::this_thread::sleep_for(milliseconds(300));
      close(port);
    });
    tell(name, [&] { return wait(port); });
    closing.join();
  };
  tell_closed("select-closed", [](int port) {
    fd_set set;
    FD_ZERO(&set);
    FD_SET(port, &set);
    timeval length{2, 0};
    return select(port + 1, &set, nullptr, nullptr, &length) == 0;
  });
  tell_closed("poll-closed", [](int port) {
    pollfd entry{port, POLLIN, 0};
    return poll(&entry, 1, 2'000) == 1 && entry.revents == POLLNVAL;
  });
  tell_closed("read-closed", [](int port) {
    char byte = 0;
    return read(port, &byte, 1) == 0;
  });
}

}  // namespace

int main() {
  std::atomic<bool> is_over = false;
  std::atomic<int> beats = 0;
  std::thread beating([&] {
    while (!is_over) {
      std::this_thread::sleep_for(milliseconds(10));
      ++beats;
    }
  });
  wait_for_each_other();
  wait_for_timers();
  wait_for_the_line();
  wait_until_interrupted();
  wait_for_a_closed_port();
  is_over = true;
  beating.join();
  std::printf("beats %d\n", beats.load() / 100);
  return 0;
}
