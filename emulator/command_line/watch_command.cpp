// `understudy ctl watch`: a table that is kept up to date.
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <optional>
#include <utility>

#include "emulator/command_line/commands.h"
#include "emulator/control/server.h"
#include "emulator/control/watch_table.h"
#include "emulator/one_line.h"
#include "emulator/simulated_time.h"

namespace understudy::emulator {

namespace {

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t is_over = 0;

/// The terminal's other screen, without a cursor, for as long as this lives. What the user had on the
/// terminal is there again afterwards.
class Screen {
 public:
  Screen() { put("\x1b[?1049h\x1b[?25l"); }
  ~Screen() { put("\x1b[?25h\x1b[?1049l"); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// Written over what is there, in one piece: a screen that is cleared first flickers.
  static void show(const std::vector<std::string>& lines) {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0) size = {24, 80, 0, 0};
    std::string text = "\x1b[H";
    for (std::size_t i = 0; i < lines.size() && i < size.ws_row; ++i) {
      text += (i == 0 ? "" : "\n") + lines[i].substr(0, size.ws_col) + "\x1b[K";
    }
    put(text + "\x1b[J");
  }

 private:
  static void put(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
  }
};

void print(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::printf("%s\n", line.c_str());
  std::printf("\n");
  std::fflush(stdout);
}

void watch_for_the_end() {
  struct sigaction action {};
  action.sa_handler = [](int) { is_over = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

int watch(const WatchArguments& arguments) {
  const auto every = parse_duration(arguments.every);
  if (!every || *every < std::chrono::milliseconds(10)) {
    throw UsageError("ctl watch: --every: " + quoted(arguments.every) + " is no time; expected 10ms or more");
  }
  if (arguments.times < 0) throw UsageError("ctl watch: --times: expected 0 (without end) or more");
  const std::string path = socket_path(arguments.socket);
  std::string before;
  Clock::time_point asked_before{};
  // Nobody answers? That is told before the terminal is touched.
  std::string status = ask_control(path, R"({"do":"status"})");
  watch_for_the_end();
  std::optional<Screen> screen;
  if (isatty(STDOUT_FILENO) != 0) screen.emplace();
  for (int i = 0; is_over == 0; ++i) {
    const Clock::time_point asked = Clock::now();
    if (i > 0) status = ask_control(path, R"({"do":"status"})");
    const double between_s = std::chrono::duration<double>(asked - asked_before).count();
    const auto lines = watch_table(status, before, between_s);
    screen ? Screen::show(lines) : print(lines);
    before = std::exchange(status, {});
    asked_before = asked;
    if (i + 1 == arguments.times) break;
    const auto wait = std::chrono::duration_cast<std::chrono::nanoseconds>(*every);
    timespec time{wait.count() / 1'000'000'000, wait.count() % 1'000'000'000};
    nanosleep(&time, nullptr);  // a signal ends it early
  }
  return kExitWell;
}

}  // namespace understudy::emulator
