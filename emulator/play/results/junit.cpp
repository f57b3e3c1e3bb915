#include "emulator/play/results/junit.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"

namespace understudy::emulator::play {

namespace {

using Verdict = ScenarioResult::Verdict;

/// The length of the UTF-8 character at the beginning; 0 if there is none that XML can hold.
std::size_t character_size(std::string_view text) {
  const auto at = [&](std::size_t i) {
    return i < text.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])) : 0U;
  };
  const std::uint32_t first = at(0);
  if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  std::uint32_t code = first & (size == 2 ? 0x1FU : size == 3 ? 0x0FU : 0x07U);
  for (std::size_t i = 1; i < size; ++i) {
    if ((at(i) & 0xC0U) != 0x80U) return 0;
    code = code << 6 | (at(i) & 0x3FU);
  }
  const bool is_too_long = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  return is_too_long || is_surrogate || code > 0x10FFFF || code == 0xFFFE || code == 0xFFFF ? 0 : size;
}

struct Counts {
  std::size_t tests = 0;
  std::size_t failures = 0;
  std::size_t skipped = 0;
  SimTime time{0};

  void add(const ScenarioResult& result) {
    ++tests;
    if (result.verdict == Verdict::failed) ++failures;
    if (result.verdict == Verdict::not_reached) ++skipped;
    time += result.simulated;
  }
  std::string text() const {
    return "tests=\"" + std::to_string(tests) + "\" failures=\"" + std::to_string(failures) +
           "\" errors=\"0\" skipped=\"" + std::to_string(skipped) + "\" time=\"" + seconds_text(time) + "\"";
  }
};

std::string lines_text(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string case_text(const ScenarioResult& result) {
  std::string text = "    <testcase classname=\"" + xml_escaped(result.file) + "\" name=\"" +
                     xml_escaped(result.name) + "\" time=\"" + seconds_text(result.simulated) + "\">\n";
  if (result.verdict == Verdict::not_reached) {
    text += "      <skipped message=\"a step before its fork failed\"/>\n";
  }
  if (result.failure) {
    text += "      <failure type=\"expectation\" message=\"" + xml_escaped(result.failure->what) + "\">" +
            xml_escaped(lines_text(failure_lines(result))) + "</failure>\n";
  }
  std::string output = lines_text(step_lines(result));
  for (const std::string& finding : result.manners) output += "lint: " + finding + "\n";
  if (!output.empty()) text += "      <system-out>" + xml_escaped(output) + "</system-out>\n";
  return text + "    </testcase>\n";
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  // Each pass takes a character at least.
  for (std::size_t left = text.size(); left > 0 && !text.empty(); --left) {
    const std::size_t size = character_size(text);
    const char c = text.front();
    if (size == 0) {
      escaped += "\xEF\xBF\xBD";
    } else if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";  // "]]>" may not stand in a text
    } else if (c == '"') {
      escaped += "&quot;";
    } else if (c == '\r') {
      escaped += "&#13;";
    } else {
      escaped += text.substr(0, size);
    }
    text.remove_prefix(std::max(size, std::size_t{1}));
  }
  return escaped;
}

std::string junit_text(std::span<const ScenarioResult> results) {
  std::vector<std::string> files;
  Counts all;
  for (const ScenarioResult& result : results) {
    all.add(result);
    if (std::find(files.begin(), files.end(), result.file) == files.end()) files.push_back(result.file);
  }
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"understudy\" " + all.text() + ">\n";
  for (const std::string& file : files) {
    Counts counts;
    std::string cases;
    for (const ScenarioResult& result : results) {
      if (result.file != file) continue;
      counts.add(result);
      cases += case_text(result);
    }
    text += "  <testsuite name=\"" + xml_escaped(file) + "\" " + counts.text() + ">\n" + cases +
            "  </testsuite>\n";
  }
  return text + "</testsuites>\n";
}

}  // namespace understudy::emulator::play
