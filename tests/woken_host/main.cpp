// A host of several processes whose waits end from elsewhere: by signals of every origin, by the end of a
// process, and by what one process gives another. Each wait would last 100 s, and something ends it after 3
// s, or at once. It prints the cells of the tables that took another time, and how many cells there are.
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/select.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>

namespace {

constexpr int kLong_s = 100;
constexpr int kSoon_s = 3;

double now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / 1e9;
}

timespec in(clockid_t clock, int seconds) {
  timespec time{};
  clock_gettime(clock, &time);
  time.tv_sec += seconds;
  return time;
}

constexpr timespec kLength{kLong_s, 0};

/// What processes share: a child gets it from its parent.
struct Shared {
  sem_t semaphore;
  pthread_mutex_t mutex;
  pthread_cond_t condition;
  int pipe[2];
  int counter;  // an eventfd
};
Shared* shared;

int open_port() {
  const int port = open(std::getenv("UNDERSTUDY_PORT"), O_RDWR | O_NOCTTY);
  termios settings{};
  tcgetattr(port, &settings);
  cfmakeraw(&settings);
  cfsetspeed(&settings, B19200);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  tcsetattr(port, TCSANOW, &settings);
  return port;
}

// --- waits -----------------------------------------------------------------------------------------

void sleeps() { sleep(kLong_s); }
void sleeps_by_nanosleep() { nanosleep(&kLength, nullptr); }
void sleeps_until_a_time() {
  const timespec end = in(CLOCK_MONOTONIC, kLong_s);
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &end, nullptr);
}
void polls_nothing() { poll(nullptr, 0, kLong_s * 1'000); }
void polls(int descriptor) {
  pollfd entry{descriptor, POLLIN, 0};
  poll(&entry, 1, kLong_s * 1'000);
}
void selects(int descriptor) {
  fd_set set;
  FD_ZERO(&set);
  FD_SET(descriptor, &set);
  timeval length{kLong_s, 0};
  select(descriptor + 1, &set, nullptr, nullptr, &length);
}
void waits_by_epoll(int descriptor) {
  const int epoll = epoll_create1(EPOLL_CLOEXEC);
  epoll_event event{EPOLLIN, {}};
  epoll_ctl(epoll, EPOLL_CTL_ADD, descriptor, &event);
  epoll_wait(epoll, &event, 1, kLong_s * 1'000);
}
void polls_the_line() { polls(open_port()); }
void selects_the_line() { selects(open_port()); }
void waits_by_epoll_for_the_line() { waits_by_epoll(open_port()); }
void reads_the_line() {
  char byte = 0;
  [[maybe_unused]] const ssize_t size = read(open_port(), &byte, 1);
}
void polls_a_pipe() { polls(shared->pipe[0]); }
void selects_a_pipe() { selects(shared->pipe[0]); }
void waits_by_epoll_for_a_pipe() { waits_by_epoll(shared->pipe[0]); }
void polls_a_counter() { polls(shared->counter); }
void waits_for_a_semaphore() {
  const timespec end = in(CLOCK_REALTIME, kLong_s);
  sem_timedwait(&shared->semaphore, &end);
}
void waits_for_a_condition() {
  const timespec end = in(CLOCK_REALTIME, kLong_s);
  pthread_mutex_lock(&shared->mutex);
  pthread_cond_timedwait(&shared->condition, &shared->mutex, &end);
  pthread_mutex_unlock(&shared->mutex);
}
void waits_for_another_signal() {
  sigset_t set{};
  sigaddset(&set, SIGUSR2);
  sigtimedwait(&set, nullptr, &kLength);
}
// The signal is blocked outside these.
void polls_with_a_mask() {
  const sigset_t none{};
  ppoll(nullptr, 0, &kLength, &none);
}
void selects_with_a_mask() {
  const sigset_t none{};
  pselect(0, nullptr, nullptr, nullptr, &kLength, &none);
}
void waits_by_epoll_with_a_mask() {
  const sigset_t none{};
  epoll_event event{};
  epoll_pwait(epoll_create1(EPOLL_CLOEXEC), &event, 1, kLong_s * 1'000, &none);
}

struct Wait {
  const char* name;
  void (*act)();
  enum class Ends : unsigned char { by_signals, by_early_signals, only_with_its_process } ends;
};
using Ends = Wait::Ends;
constexpr Wait kWaits[]{
    {"sleep", sleeps, Ends::by_signals},
    {"nanosleep", sleeps_by_nanosleep, Ends::by_signals},
    {"clock_nanosleep", sleeps_until_a_time, Ends::by_signals},
    {"poll", polls_nothing, Ends::by_signals},
    {"poll of the line", polls_the_line, Ends::by_signals},
    {"select of the line", selects_the_line, Ends::by_signals},
    {"epoll of the line", waits_by_epoll_for_the_line, Ends::by_signals},
    {"read of the line", reads_the_line, Ends::by_signals},
    {"poll of a pipe", polls_a_pipe, Ends::by_signals},
    {"semaphore", waits_for_a_semaphore, Ends::by_signals},
    {"sigtimedwait", waits_for_another_signal, Ends::by_signals},
    {"ppoll with a mask", polls_with_a_mask, Ends::by_early_signals},
    {"pselect with a mask", selects_with_a_mask, Ends::by_early_signals},
    {"epoll_pwait with a mask", waits_by_epoll_with_a_mask, Ends::by_early_signals},
    {"condition", waits_for_a_condition, Ends::only_with_its_process},
};

// --- ways to end them ------------------------------------------------------------------------------

/// Installs a handler that does nothing. Reads are not restarted after it.
void install(int signal_number) {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  sigaction(signal_number, &action, nullptr);
}

/// Lets a thread of this process act later, on the thread that calls this.
void later(void (*act)(pthread_t caller)) {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);  // the signal is for the other thread
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread([act, caller = pthread_self()] {
    sleep(kSoon_s);
    act(caller);
  }).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void set_an_alarm() {
  install(SIGALRM);
  alarm(kSoon_s);
}
void have_a_child_that_ends() {
  install(SIGCHLD);
  if (fork() != 0) return;
  sleep(kSoon_s);
  _exit(0);
}
void have_a_child_that_signals() {
  if (fork() != 0) return;
  sleep(kSoon_s);
  kill(getppid(), SIGUSR1);
  _exit(0);
}

struct Way {
  const char* name;
  void (*prepare)();           // in the process that waits
  void (*act)(pid_t process);  // in its parent
  bool is_deadly;
};
constexpr Way kWays[]{
    {"kill", nullptr, [](pid_t process) { kill(process, SIGUSR1); }, false},
    {"kill of the group", nullptr, [](pid_t process) { kill(-process, SIGUSR1); }, false},
    {"killpg", nullptr, [](pid_t process) { killpg(process, SIGUSR1); }, false},
    {"sigqueue", nullptr, [](pid_t process) { sigqueue(process, SIGUSR1, {}); }, false},
    {"tgkill", nullptr, [](pid_t process) { syscall(SYS_tgkill, process, process, SIGUSR1); }, false},
    {"pidfd_send_signal", nullptr,
     [](pid_t process) {
       const auto descriptor = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
       syscall(SYS_pidfd_send_signal, descriptor, SIGUSR1, nullptr, 0);
       close(descriptor);
     },
     false},
    {"stop, and go on", nullptr,
     [](pid_t process) {
       kill(process, SIGSTOP);
       kill(process, SIGCONT);
       kill(process, SIGUSR1);
     },
     false},
    {"pthread_kill", [] { later([](pthread_t caller) { pthread_kill(caller, SIGUSR1); }); }, nullptr, false},
    {"kill by a thread", [] { later([](pthread_t) { kill(getpid(), SIGUSR1); }); }, nullptr, false},
    {"an alarm", set_an_alarm, nullptr, false},
    {"the end of a child", have_a_child_that_ends, nullptr, false},
    {"kill by a child", have_a_child_that_signals, nullptr, false},
    {"SIGTERM", nullptr, [](pid_t process) { kill(process, SIGTERM); }, true},
    {"SIGKILL", nullptr, [](pid_t process) { kill(process, SIGKILL); }, true},
    {"exit by a thread", [] { later([](pthread_t) { _exit(kSoon_s); }); }, nullptr, true},
    {"abort by a thread", [] { later([](pthread_t) { std::abort(); }); }, nullptr, true},
};

/// What one process gives another.
struct Gift {
  const char* name;
  void (*wait)();
  void (*give)();
};
void write_to_the_pipe() { [[maybe_unused]] const ssize_t size = write(shared->pipe[1], "x", 1); }
constexpr Gift kGifts[]{
    {"poll of a pipe", polls_a_pipe, write_to_the_pipe},
    {"select of a pipe", selects_a_pipe, write_to_the_pipe},
    {"epoll of a pipe", waits_by_epoll_for_a_pipe, write_to_the_pipe},
    {"read of a pipe",
     [] {
       char byte = 0;
       [[maybe_unused]] const ssize_t size = read(shared->pipe[0], &byte, 1);
     },
     write_to_the_pipe},
    {"poll of a counter", polls_a_counter,
     [] {
       const std::uint64_t one = 1;
       [[maybe_unused]] const ssize_t size = write(shared->counter, &one, sizeof one);
     }},
    {"semaphore", waits_for_a_semaphore, [] { sem_post(&shared->semaphore); }},
    {"condition", waits_for_a_condition,
     [] {
       pthread_mutex_lock(&shared->mutex);
       pthread_cond_signal(&shared->condition);
       pthread_mutex_unlock(&shared->mutex);
     }},
};

// --- cells -----------------------------------------------------------------------------------------

void make_shared() {
  *shared = {};
  sem_init(&shared->semaphore, 1, 0);
  pthread_mutexattr_t mutex{};
  pthread_mutexattr_init(&mutex);
  pthread_mutexattr_setpshared(&mutex, PTHREAD_PROCESS_SHARED);
  pthread_mutex_init(&shared->mutex, &mutex);
  pthread_condattr_t condition{};
  pthread_condattr_init(&condition);
  pthread_condattr_setpshared(&condition, PTHREAD_PROCESS_SHARED);
  pthread_cond_init(&shared->condition, &condition);
  if (pipe(shared->pipe) != 0) std::abort();
  shared->counter = eventfd(0, 0);
}

void close_shared() {
  for (const int descriptor : {shared->pipe[0], shared->pipe[1], shared->counter}) close(descriptor);
}

/// Returns how long the child was there. It ends with its own account of that, unless a signal ends it.
double length_of(pid_t child, double begun) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const double length = now() - begun;
  if (WIFEXITED(status) && WEXITSTATUS(status) != static_cast<int>(length + 0.5)) return -1;
  return length;
}

int cells = 0;

void judge(const std::string& cell, double length, int expected_s) {
  ++cells;
  if (length > expected_s - 0.1 && length < expected_s + 0.1) return;
  std::printf("%s: %.1f s, expected %d s\n", cell.c_str(), length, expected_s);
}

/// Waits in a child, which is woken after a while, and expects that this takes so long.
void try_cell(const std::string& cell, int expected_s, const std::function<void()>& wait, int after_s,
              const std::function<void(pid_t)>& wake) {
  make_shared();
  const double begun = now();
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);
    wait();
    _exit(static_cast<int>(now() - begun + 0.5));
  }
  setpgid(child, child);
  if (after_s > 0) sleep(static_cast<unsigned>(after_s));
  wake(child);
  judge(cell, length_of(child, begun), expected_s);
  close_shared();
}

void try_way(const Way& way, const Wait& wait) {
  const bool has_mask = wait.ends == Ends::by_early_signals;
  const std::string cell = std::string(wait.name) + ", " + way.name;
  const auto waits = [&] {
    if (way.prepare != nullptr) way.prepare();
    wait.act();
  };
  if (way.act == nullptr) return try_cell(cell, kSoon_s, waits, 0, [](pid_t) {});
  try_cell(cell, kSoon_s, waits, kSoon_s, way.act);
  if (way.is_deadly || has_mask) try_cell(cell + " at once", 0, waits, 0, way.act);
}

}  // namespace

int main() {
  shared = static_cast<Shared*>(
      mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  install(SIGUSR1);
  for (const Way& way : kWays) {
    for (const Wait& wait : kWaits) {
      if (wait.ends == Ends::only_with_its_process && !way.is_deadly) continue;
      sigset_t blocked{};
      if (wait.ends == Ends::by_early_signals) sigaddset(&blocked, SIGUSR1);
      sigprocmask(SIG_SETMASK, &blocked, nullptr);
      try_way(way, wait);
    }
  }
  for (const Gift& gift : kGifts)
    try_cell(std::string(gift.name) + ", given", kSoon_s, gift.wait, kSoon_s, [&](pid_t) { gift.give(); });
  std::printf("%d cells\n", cells);
  return 0;
}
