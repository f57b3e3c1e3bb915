#include "emulator/command_line/interruption.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string_view>

#include "base/simulated_time.h"

namespace understudy::emulator::command_line {

namespace {

volatile std::sig_atomic_t is_over = 0;

}  // namespace

void watch_for_interruption() {
  struct sigaction action {};
  action.sa_handler = [](int) { is_over = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // The terminal was closed (nohup ignores this signal), or the reader of the output has ended.
  for (const int number : {SIGHUP, SIGPIPE}) {
    struct sigaction before {};
    sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
}

void watch_for_interruption_of_machine() {
  watch_for_interruption();
  struct sigaction action {};
  action.sa_handler = [](int) { is_over = 1; };
  sigaction(SIGQUIT, &action, nullptr);
  action.sa_handler = [](int) {
    constexpr std::string_view kRefusal =
        "\nunderstudy: Ctrl-Z is refused, because the machine may move; Ctrl-C stops it, and ends the "
        "program\n";
    const int before = errno;
    const auto ignored = write(STDERR_FILENO, kRefusal.data(), kRefusal.size());
    static_cast<void>(ignored);
    errno = before;
  };
  sigaction(SIGTSTP, &action, nullptr);
}

bool is_interrupted() { return is_over != 0; }

void wait_or_be_interrupted(SimTime time) {
  const timespec wait{time.count() / 1'000'000'000, time.count() % 1'000'000'000};
  nanosleep(&wait, nullptr);  // a signal ends it early
}

}  // namespace understudy::emulator::command_line
