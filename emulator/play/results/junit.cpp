#include "emulator/play/results/junit.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"

namespace understudy::emulator::play {

namespace {

using Verdict = ScenarioResult::Verdict;

/// Returns the size of the UTF-8 character at the beginning of the text, or 0 if XML cannot contain it.
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

std::string counts_text(const Tally& tally) {
  const std::uint64_t skipped = tally.not_reached + tally.not_tellable;
  return "tests=\"" + std::to_string(tally.passed + tally.failed + skipped) + "\" failures=\"" +
         std::to_string(tally.failed - tally.unreadable) + "\" errors=\"" + std::to_string(tally.unreadable) +
         "\" skipped=\"" + std::to_string(skipped) + "\" time=\"" + seconds_text(tally.simulated) + "\"";
}

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
  if (result.verdict == Verdict::not_tellable) {
    const std::vector<std::string> why = skipped_lines(result);
    text += "      <skipped message=\"not tellable" + xml_escaped(why.empty() ? "" : ": " + why.front()) +
            "\"/>\n";
  }
  const bool is_one_of_many = result.which.is_varied && (!result.failure || !result.like.empty());
  if (result.failure) {
    const std::string tag = result.is_unreadable ? "error type=\"case\"" : "failure type=\"expectation\"";
    text += "      <" + tag + " message=\"" + xml_escaped(result.failure->what) + "\">" +
            xml_escaped(is_one_of_many ? "" : lines_text(failure_lines(result))) + "</" +
            tag.substr(0, tag.find(' ')) + ">\n";
  }
  std::string output = lines_text(is_one_of_many ? skipped_lines(result) : step_lines(result));
  for (const std::string& finding : result.lint_findings) output += "lint: " + finding + "\n";
  if (!output.empty()) text += "      <system-out>" + xml_escaped(output) + "</system-out>\n";
  return text + "    </testcase>\n";
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  // Each iteration consumes at least one character.
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
      escaped += "&gt;";  // a text must not contain "]]>"
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

void Junit::fail() {
  throw std::system_error(errno, std::generic_category(), "--junit: results cannot be stored in /tmp");
}

Junit::Junit() : waiting_(std::tmpfile(), &std::fclose) {
  if (!waiting_) fail();
}

void Junit::add(const ScenarioResult& result) {
  const auto [it, is_new] = numbers_.emplace(result.file, suites_.size());
  if (is_new) suites_.push_back({.file = result.file});
  Suite& suite = suites_[it->second];
  suite.tally.add(result);
  all_.add(result);
  const std::string text = case_text(result);
  if (std::fwrite(text.data(), 1, text.size(), waiting_.get()) != text.size()) fail();
  if (suite.pieces.empty() || suite.pieces.back().end != end_)
    suite.pieces.push_back({.begin = end_, .end = end_});
  end_ += static_cast<long>(text.size());
  suite.pieces.back().end = end_;
}

void Junit::write(const std::function<void(std::string_view)>& take) {
  take("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"understudy\" " + counts_text(all_) +
       ">\n");
  std::vector<char> part(std::size_t{1} << 16);
  for (const Suite& suite : suites_) {
    take("  <testsuite name=\"" + xml_escaped(suite.file) + "\" " + counts_text(suite.tally) + ">\n");
    for (const Piece& piece : suite.pieces) {
      if (std::fflush(waiting_.get()) != 0 || std::fseek(waiting_.get(), piece.begin, SEEK_SET) != 0) fail();
      for (long left = piece.end - piece.begin; left > 0;) {
        const std::size_t wanted = std::min(part.size(), static_cast<std::size_t>(left));
        if (std::fread(part.data(), 1, wanted, waiting_.get()) != wanted) fail();
        take({part.data(), wanted});
        left -= static_cast<long>(wanted);
      }
    }
    take("  </testsuite>\n");
  }
  take("</testsuites>\n");
}

std::string junit_text(std::span<const ScenarioResult> results) {
  Junit junit;
  for (const ScenarioResult& result : results) junit.add(result);
  std::string text;
  junit.write([&](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace understudy::emulator::play
