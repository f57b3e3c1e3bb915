#include "emulator/command_line/terminal.h"

#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

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

std::string progress_text(std::uint64_t done, std::uint64_t total, std::uint64_t failed, double seconds) {
  std::string text = std::to_string(done) + " of " + std::to_string(total) + " played, ";
  if (failed > 0) text += std::to_string(failed) + " failed, ";
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
  char figures[40];
  std::snprintf(figures, sizeof figures, rate < 10 ? "%.1f/s" : "%.0f/s", rate);
  text += figures;
  if (done == 0 || done > total) return text;
  const auto left = static_cast<std::uint64_t>(static_cast<double>(total - done) / rate + 0.5);
  constexpr std::uint64_t kMinute = 60;
  constexpr std::uint64_t kHour = 3600;
  if (left >= kHour) {
    text +=
        ", " + std::to_string(left / kHour) + " h " + std::to_string(left % kHour / kMinute) + " min left";
  } else if (left >= kMinute) {
    text += ", " + std::to_string(left / kMinute) + " min " + std::to_string(left % kMinute) + " s left";
  } else {
    text += ", " + std::to_string(left) + " s left";
  }
  return text;
}

ProgressLine::ProgressLine(std::uint64_t total, bool is_wanted)
    : ProgressLine([this](double seconds) { return progress_text(done_, total_, failed_, seconds); },
                   is_wanted) {
  total_ = total;
}

ProgressLine::ProgressLine(std::function<std::string(double)> text_of, bool is_wanted)
    : text_of_(std::move(text_of)) {
  const bool is_watched = is_wanted && isatty(STDERR_FILENO) != 0 && !is_dumb() && !is_set("CI");
  if (is_watched) thread_ = std::thread([this] { run(); });
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
  std::fputs("\r\x1b[K", stderr);
  is_shown_ = false;
}

void ProgressLine::run() {
  const auto begin = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  over_.wait_for(lock, kFirst, [this] { return is_over_; });
  while (!is_over_) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    std::fprintf(stderr, "\r%s\x1b[K", text_of_(passed.count()).c_str());
    is_shown_ = true;
    over_.wait_for(lock, kEvery, [this] { return is_over_; });
  }
}

}  // namespace understudy::emulator::command_line
