#include "tests/emulator/models/simple2_r3/programs/course_text.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "interpreter/simple2/execution/execution.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

/// "L0-L255" is L0, L1 and so on.
void add_lines(const std::string& word, std::vector<std::string>& words) {
  const std::size_t dash = word.find("-L");
  if (!word.starts_with('L') || dash == std::string::npos) {
    words.push_back(word);
    return;
  }
  const int last = std::stoi(word.substr(dash + 2));
  for (int line = std::stoi(word.substr(1, dash - 1)); line <= last; ++line) {
    words.push_back("L" + std::to_string(line));
  }
}

}  // namespace

Course course_of_table(std::string_view table) {
  Course course;
  Tick base = 0;
  std::istringstream lines{std::string(table)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream text(line.substr(0, line.find(';')));
    std::string time;
    if (!(text >> time)) continue;
    std::vector<std::string> words;
    for (std::string word; text >> word;) add_lines(word, words);
    if (words.empty()) throw std::invalid_argument("nothing happens in '" + line + "'");

    const bool is_relative = time.starts_with('+');
    if (const std::size_t dots = time.find(".."); dots != std::string::npos) {
      const Tick first = std::stoll(time.substr(0, dots)) + (is_relative ? base : 0);
      const Tick last = std::stoll(time.substr(dots + 2)) + (is_relative ? base : 0);
      std::size_t next = 0;
      for (Tick ms = first; ms <= last; ms += interpreter::simple2::kSlotMs) {
        course[ms].insert(words[next++ % words.size()]);
      }
      continue;
    }
    const Tick ms = std::stoll(time) + (is_relative ? base : 0);
    if (!is_relative) base = ms;
    course[ms].insert(words.begin(), words.end());
  }
  return course;
}

std::string to_string(const Course& course, Tick from, int count) {
  std::string text;
  for (auto at = course.lower_bound(from); at != course.end() && count-- > 0; ++at) {
    text += "  " + std::to_string(at->first) + " ";
    for (const std::string& event : at->second) text += " " + event;
    text += "\n";
  }
  return text;
}

Tick first_difference(const Course& a, const Course& b) {
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (in_a == a.end()) return in_b == b.end() ? -1 : in_b->first;
  return in_b == b.end() ? in_a->first : std::min(in_a->first, in_b->first);
}

}  // namespace understudy::emulator::models::simple2_r3
