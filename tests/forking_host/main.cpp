// A host that starts processes in every way. Each child works for a moment and sleeps for two seconds, while
// another thread of the host sleeps for long. It prints the ways that took another time, and how many there
// are. With the argument `background`, it becomes a daemon that sleeps instead.
#include <pty.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include <wordexp.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr int kCode = 5;
constexpr const char* kCommand = "sleep 2; exit 5";

double now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / 1e9;
}

/// The child says nothing to the bench meanwhile.
int work_and_sleep(void*) {
  volatile long sum = 0;
  for (long i = 0; i < 5'000'000; ++i) sum = sum + i;
  sleep(2);
  _exit(kCode);
}

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -1; }

int end_of(long child) {
  if (child == 0) work_and_sleep(nullptr);
  int status = -1;
  waitpid(static_cast<pid_t>(child), &status, 0);
  return code_of(status);
}

int by_vfork() {
  const pid_t child = vfork();
  if (child == 0) {
    execlp("sh", "sh", "-c", kCommand, static_cast<char*>(nullptr));
    _exit(127);
  }
  return end_of(child);
}

int by_forkpty() {
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  const int code = end_of(child);
  close(terminal);
  return code;
}

int by_clone() {
  static std::array<std::byte, 65536> stack;
  return end_of(clone(work_and_sleep, stack.data() + stack.size(), SIGCHLD, nullptr));
}

int by_spawn() {
  std::string command = kCommand;
  std::string shell = "sh";
  std::string flag = "-c";
  const std::array<char*, 4> words{shell.data(), flag.data(), command.data(), nullptr};
  pid_t child = -1;
  posix_spawnp(&child, "sh", nullptr, nullptr, words.data(), environ);
  return end_of(child);
}

int by_popen() {
  FILE* const file = popen(kCommand, "r");
  return code_of(pclose(file));
}

int by_wordexp() {
  wordexp_t words{};
  if (wordexp("$(sleep 1; echo 3) $(sleep 1; echo 2)", &words, 0) != 0) return -1;
  const int sum = std::atoi(words.we_wordv[0]) + std::atoi(words.we_wordv[1]);
  wordfree(&words);
  return sum;
}

/// The first child ends at once, and leaves the second one behind. A pipe closes when that ends.
int by_orphan() {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return -1;
  if (syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0) == 0) {
    if (syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0) == 0) work_and_sleep(nullptr);
    _exit(0);
  }
  close(ends[1]);
  char nothing = 0;
  const bool is_closed = read(ends[0], &nothing, 1) == 0;
  close(ends[0]);
  wait(nullptr);
  return is_closed ? kCode : -1;
}

struct Way {
  const char* name;
  int (*run)();
};

int run_in_background() {
  if (daemon(1, 1) != 0) return 1;
  while (true) sleep(1);
}

}  // namespace

int main(int count, char** words) {
  if (count > 1 && std::string(words[1]) == "background") return run_in_background();
  const std::vector<Way> ways{
      {"fork", [] { return end_of(fork()); }},
      {"_Fork", [] { return end_of(_Fork()); }},
      {"vfork", by_vfork},
      {"forkpty", by_forkpty},
      {"clone", by_clone},
      {"SYS_clone", [] { return end_of(syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0)); }},
      {"posix_spawn", by_spawn},
      {"system", [] { return code_of(std::system(kCommand)); }},
      {"popen", by_popen},
      {"wordexp", by_wordexp},
      {"orphan", by_orphan},
  };
  const bool has_thread = count > 1 && std::string(words[1]) == "threads";
  if (has_thread) {
    std::thread([] {
      while (true) sleep(1000);
    }).detach();
  }
  for (const Way& way : ways) {
    const double begin = now();
    const int code = way.run();
    const double took = now() - begin;
    if (code != kCode || took < 1.999 || took > 2.001) std::printf("%s: %d, %.3f s\n", way.name, code, took);
  }
  std::printf("%zu ways\n", ways.size());
  std::fflush(stdout);
  _exit(0);
}
