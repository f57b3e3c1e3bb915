// Implements `understudy ctl watch`, a table that is kept up to date.
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/command_line/choose_daemon.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/interruption.h"
#include "emulator/serve/control/scrolled_view.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/watch_table.h"

namespace understudy::emulator::command_line {

namespace {

using Clock = std::chrono::steady_clock;

/// During its lifetime, reads single keys without echoing them. Ctrl-C still works.
class Keyboard {
 public:
  Keyboard() : exists_(isatty(STDIN_FILENO) != 0 && tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!exists_) return;
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    exists_ = tcsetattr(STDIN_FILENO, TCSANOW, &raw) == 0;
  }
  ~Keyboard() {
    if (exists_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;
  bool exists() const { return exists_; }
  void forget() { exists_ = false; }  // the terminal has hung up

 private:
  termios before_{};
  bool exists_ = false;
};

/// During its lifetime, shows the terminal's alternate screen without a cursor. Afterwards, the previous
/// content appears again.
class Screen {
 public:
  Screen() { put("\x1b[?1049h\x1b[?25l"); }
  ~Screen() { put("\x1b[?25h\x1b[?1049l"); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// Overwrites the old lines in a single write, because clearing the screen first would make it flicker.
  void show(const std::vector<std::string>& lines) {
    const winsize size = size_now();
    std::string text = "\x1b[H";
    for (const std::string& line : view_.fit(lines, size.ws_row, size.ws_col)) {
      text += (text.size() == 3 ? "" : "\n") + line + "\x1b[K";
    }
    put(text + "\x1b[J");
  }
  static std::size_t columns() { return size_now().ws_col; }

  /// Waits this long, or until a signal or a key arrives. Returns false if the user wants to quit.
  bool wait(Clock::duration time) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(time).count();
    pollfd keyboard{keyboard_.exists() ? STDIN_FILENO : -1, POLLIN, 0};
    if (poll(&keyboard, 1, static_cast<int>(std::max<std::int64_t>(left, 0))) <= 0) return true;
    std::array<char, 64> keys{};
    const ssize_t size = read(STDIN_FILENO, keys.data(), keys.size());
    if (size <= 0) {
      keyboard_.forget();
      return true;
    }
    return !view_.press({keys.data(), static_cast<std::size_t>(size)});
  }

 private:
  static void put(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
  }
  static winsize size_now() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0 || size.ws_col == 0) {
      size = {24, 80, 0, 0};
    }
    return size;
  }

  Keyboard keyboard_;
  serve::ScrolledView view_;
};

void print(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::printf("%s\n", line.c_str());
  std::printf("\n");
  std::fflush(stdout);
}

/// Formats replies as lines of the display. A later reply may be a refusal, for example because a device has
/// no power; the refusal is then shown.
class Shown {
 public:
  explicit Shown(std::vector<std::string> names) : names_(std::move(names)) {}
  std::string message() const { return names_.empty() ? R"({"do":"status"})" : serve::get_message(names_); }
  std::vector<std::string> lines_of(const std::string& reply, Clock::time_point asked,
                                    std::optional<std::size_t> columns) {
    if (!names_.empty()) return serve::watch_values(reply);
    const double between_s = std::chrono::duration<double>(asked - asked_before_).count();
    std::vector<std::string> lines = columns ? serve::watch_table(reply, before_, between_s, *columns)
                                             : serve::watch_table(reply, before_, between_s);
    before_ = reply;
    asked_before_ = asked;
    return lines;
  }

 private:
  std::vector<std::string> names_;
  std::string before_;
  Clock::time_point asked_before_{};
};

}  // namespace

int watch(const WatchArguments& arguments) {
  const auto every = parse_duration(arguments.every);
  if (!every || *every < std::chrono::milliseconds(10)) {
    throw UsageError("ctl watch: --every: " + understudy::quoted(arguments.every) +
                     " is not a valid interval; expected 10ms or more");
  }
  if (arguments.times < 0) throw UsageError("ctl watch: --times: expected 0 (no limit) or more");
  const std::string path = choose_daemon(arguments.which);
  Shown shown(arguments.names);
  // Errors, such as a missing daemon or name, are reported before the terminal is changed.
  std::string reply = serve::ask_control(path, shown.message());
  if (const std::string why = serve::why_refused(reply); !why.empty()) {
    std::fprintf(stderr, "understudy: ctl watch: %s\n", one_line(why).c_str());
    return kExitBadInput;
  }
  watch_for_interruption();
  std::optional<Screen> screen;
  if (isatty(STDOUT_FILENO) != 0) screen.emplace();
  for (int i = 0; !is_interrupted(); ++i) {
    const Clock::time_point asked = Clock::now();
    if (i > 0) reply = serve::ask_control(path, shown.message());
    const auto columns = screen ? std::optional(Screen::columns()) : std::nullopt;
    const auto lines = shown.lines_of(reply, asked, columns);
    screen ? screen->show(lines) : print(lines);
    if (i + 1 == arguments.times) break;
    if (!screen) {
      wait_or_be_interrupted(*every);
      continue;
    }
    const Clock::time_point next = asked + *every;
    while (!is_interrupted() && Clock::now() < next) {
      if (!screen->wait(next - Clock::now())) return kExitWell;
      screen->show(lines);
    }
  }
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
