#include "emulator/command_line/exec_courses.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/files/text_file.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"

namespace understudy::emulator::command_line {

namespace {

// A line begins with the time and the kind of the event.
constexpr std::size_t kLongestBegin = 48;

/// Returns the event's simulated time. Every event begins with it.
std::string time_in(std::string_view event) {
  constexpr std::string_view kBegin = "{\"t\":";
  if (!event.starts_with(kBegin)) return "its end";
  return format_duration(SimTime{std::strtoll(event.data() + kBegin.size(), nullptr, 10)});
}

std::string shown(std::string_view event) {
  constexpr std::size_t kMax = 100;
  if (event.empty()) return "nothing";
  return one_line(std::string(event.substr(0, kMax))) + (event.size() > kMax ? "..." : "");
}

/// Returns a recording without the waits of its host.
std::string without_waits(std::string_view text) {
  std::string rest;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.substr(0, kLongestBegin).find(R"("do":"wait")") != std::string_view::npos) continue;
    rest += line;
    rest += '\n';
  }
  return rest;
}

/// Returns the line that contains the position.
std::string_view line_at(std::string_view text, std::size_t place) {
  const std::size_t before = place == 0 ? std::string_view::npos : text.rfind('\n', place - 1);
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

std::string Courses::add(const std::string& recording) {
  std::string text = without_waits(read_text_file(recording).value_or(""));
  ++runs_;
  for (Course& course : courses_) {
    if (course.text != text) continue;
    ++course.runs;
    return {};
  }
  courses_.push_back({std::move(text), 1});
  if (courses_.size() == 1) return {};
  const std::string& first = courses_.front().text;
  const std::string& other = courses_.back().text;
  const auto [in_first, in_other] = std::ranges::mismatch(first, other);
  const auto place = static_cast<std::size_t>(in_first - first.begin());
  const std::string_view line = line_at(other, place);
  const std::string run = "run " + std::to_string(runs_) + " differs from run 1";
  if (place < first.find('\n')) {
    return run +
           " from the beginning: the devices' memories differ; expected a bench that keeps no memories in "
           "files";
  }
  return run + " at " + time_in(line) + ": " + shown(line) + "; expected " + shown(line_at(first, place));
}

std::string Courses::summary() const {
  std::string text = std::to_string(runs_) + " runs, ";
  if (courses_.size() == 1) return text + "all the same";
  text += std::to_string(courses_.size()) + " different courses:";
  for (const Course& course : courses_) text += " " + std::to_string(course.runs);
  return text;
}

}  // namespace understudy::emulator::command_line
