#include "emulator/command_line/terminal.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <string_view>

namespace understudy::emulator::command_line {

namespace {

constexpr std::chrono::milliseconds kFirst{1'000};
constexpr std::chrono::milliseconds kEvery{250};

bool is_set(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool is_dumb() { return is_set("TERM") && std::string_view(std::getenv("TERM")) == "dumb"; }

}  // namespace

bool wants_colour(int descriptor) { return isatty(descriptor) != 0 && !is_set("NO_COLOR") && !is_dumb(); }

std::string coloured_verdict(const std::string& line, bool with_colour) {
  if (!with_colour) return line;
  const std::size_t end = line.find(' ');
  const std::string word = line.substr(0, end);
  const char* const colour = word == "ok" ? "32" : word == "FAIL" ? "1;31" : word == "-" ? "33" : nullptr;
  if (colour == nullptr || end == std::string::npos) return line;
  return "\x1b[" + std::string(colour) + "m" + word + "\x1b[0m" + line.substr(end);
}

ProgressLine::ProgressLine(std::size_t total) : total_(total) {
  if (isatty(STDOUT_FILENO) != 0 && !is_dumb()) thread_ = std::thread([this] { run(); });
}

ProgressLine::~ProgressLine() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    wipe();
  }
  over_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void ProgressLine::wipe() {
  if (!is_shown_) return;
  std::fputs("\r\x1b[K", stdout);
  std::fflush(stdout);
  is_shown_ = false;
}

void ProgressLine::run() {
  const auto begin = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  over_.wait_for(lock, kFirst, [this] { return is_over_; });
  while (!is_over_) {
    const auto seconds =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begin);
    std::printf("\r%zu of %zu played, %lld s\x1b[K", done_, total_, static_cast<long long>(seconds.count()));
    std::fflush(stdout);
    is_shown_ = true;
    over_.wait_for(lock, kEvery, [this] { return is_over_; });
  }
}

}  // namespace understudy::emulator::command_line
