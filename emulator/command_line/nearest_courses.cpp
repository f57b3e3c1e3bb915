#include "emulator/command_line/nearest_courses.h"

#include <cstddef>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::command_line {

namespace {

/// Returns the lines of a program, from its listing or its file.
std::vector<std::string> lines_of(const std::string& path, const world::CoveredFile& file) {
  std::istringstream text(file.listing.empty() ? read_text_file(path).value_or("") : file.listing);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(one_line(line));
  return lines;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

/// Describes the unreached part of a line; empty if all of it was reached.
std::string gap_of(const world::CoveredLine& line) {
  if (line.runs == 0) return "never ran";
  if (!line.decides || (line.yes > 0 && line.no > 0)) return "";
  return line.yes > 0 ? "its decision was never no" : "its decision was never yes";
}

}  // namespace

void NearestCourses::add(const world::CoverageReport& report, std::size_t size, const std::string& text) {
  const std::size_t number = courses_.size();
  courses_.push_back(text);
  for (const auto& [path, file] : report.files) {
    auto& lines = by_line_[path];
    for (const auto& [line, counts] : file.lines) {
      if (counts.runs == 0) continue;
      const auto [it, is_new] = lines.try_emplace(line, Nearest{.size = size, .number = number});
      if (!is_new && size < it->second.size) it->second = {.size = size, .number = number};
    }
  }
}

/// Describes the nearest course to a line.
std::string NearestCourses::nearest_to(const std::string& path, int line) const {
  const auto file = by_line_.find(path);
  if (file == by_line_.end()) return "";
  auto it = file->second.upper_bound(line);
  if (it == file->second.begin()) return "";
  --it;
  const std::string& course = courses_[it->second.number];
  return "line " + std::to_string(it->first) + " ran " +
         (course.empty() ? "without disturbances" : "with " + course);
}

std::vector<Gap> NearestCourses::gaps(const world::CoverageReport& all) const {
  std::vector<Gap> gaps;
  for (const auto& [path, file] : all.files) {
    std::optional<std::vector<std::string>> lines;
    for (const auto& [number, line] : file.lines) {
      const std::string gap = gap_of(line);
      if (gap.empty()) continue;
      if (!lines) lines = lines_of(path, file);
      const auto index = static_cast<std::size_t>(number) - 1;
      const std::string words = index < lines->size() ? trimmed((*lines)[index]) + ": " : "";
      gaps.push_back({.text = one_line(path + ":" + std::to_string(number) + ": " + words + gap),
                      .nearest = nearest_to(path, number)});
    }
  }
  return gaps;
}

}  // namespace understudy::emulator::command_line
