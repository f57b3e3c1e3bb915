// Measures the cost of a device without a host: the share of a processor that `understudy serve` uses,
// compared with a bare 1 kHz timer loop over the same seconds.
#include <sys/timerfd.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <thread>

#include "benchmarks/figures.h"
#include "benchmarks/host.h"
#include "benchmarks/understudy_server.h"

namespace understudy::benchmarks {

namespace {

constexpr double kBar = 0.5;  // relative to the timer loop's share
constexpr int kDefaultSeconds = 4;

void run_timer_loop() {
  const int timer = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC);
  constexpr timespec kMillisecond{.tv_sec = 0, .tv_nsec = 1'000'000};
  const itimerspec every{.it_interval = kMillisecond, .it_value = kMillisecond};
  timerfd_settime(timer, 0, &every, nullptr);
  for (std::uint64_t expirations = 0; read(timer, &expirations, sizeof expirations) > 0;) {
  }
}

struct Shares {
  double understudy = 0;  // per cent of one processor
  double timer_loop = 0;
};

Shares measure(const char* what, const Process& understudy, const Process& timer_loop, int seconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // lets earlier work end
  const Nanoseconds start = now();
  const Nanoseconds understudy_before = understudy.processor_time();
  const Nanoseconds timer_before = timer_loop.processor_time();
  std::this_thread::sleep_for(std::chrono::seconds(seconds));
  const double percent = 100.0 / static_cast<double>((now() - start).count());
  const Shares shares{
      .understudy = static_cast<double>((understudy.processor_time() - understudy_before).count()) * percent,
      .timer_loop = static_cast<double>((timer_loop.processor_time() - timer_before).count()) * percent};
  std::printf("%-28s %9.4f %% %9.4f %% %9.3f\n", what, shares.understudy, shares.timer_loop,
              shares.understudy / shares.timer_loop);
  return shares;
}

void run(const std::string& executable, int seconds) {
  const Process timer_loop = Process::of_function(run_timer_loop);
  const UnderstudyServer server(executable, "wire");
  std::printf("%d s each %34s %11s %9s\n", seconds, "understudy", "timer loop", "ratio");
  const Shares closed = measure("no host", server.process(), timer_loop, seconds);
  const Host host(server.port());
  const Shares silent = measure("a silent host", server.process(), timer_loop, seconds);
  server.start_long_move();
  measure("a silent host, a moving axis", server.process(), timer_loop, seconds);
  print_verdict("idle without a host, relative to the timer loop", closed.understudy / closed.timer_loop,
                kBar);
  print_verdict("idle with a silent host, relative to the timer loop", silent.understudy / silent.timer_loop,
                kBar);
}

}  // namespace

}  // namespace understudy::benchmarks

/// Usage: idle [SECONDS [EXECUTABLE]]
int main(int count, char** arguments) {
  using namespace understudy::benchmarks;
  try {
    const int seconds = count > 1 ? std::atoi(arguments[1]) : kDefaultSeconds;
    if (seconds < 1) throw CannotRun("SECONDS: expected a positive number");
    run(count > 2 ? arguments[2] : UNDERSTUDY_EXECUTABLE, seconds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "idle: %s\n", error.what());
    return 2;
  }
}
