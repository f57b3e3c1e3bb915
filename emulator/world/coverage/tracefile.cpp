#include "emulator/world/coverage/tracefile.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/lines.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"

namespace understudy::emulator::world {

namespace {

constexpr std::int64_t kMaxCount = std::int64_t{1} << 53;  // the sums of many files stay exact

std::vector<std::string_view> fields_of(std::string_view text) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = text.find(',');
    fields.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    text.remove_prefix(comma + 1);
  }
}

class TracefileReader {
 public:
  explicit TracefileReader(const std::string& file) : file_(file) {}

  void take(TextLine line) {
    line_ = line.number;
    std::string_view text = line.text;
    if (text.ends_with('\r')) text.remove_suffix(1);
    if (text == "end_of_record") return end_record();
    const std::size_t colon = text.find(':');
    const std::string_view word = text.substr(0, colon);
    const std::string_view value = colon == std::string_view::npos ? "" : text.substr(colon + 1);
    if (word == "SF") return begin_record(value);
    if (word == "DA") return take_line(value);
    if (word == "BRDA") return take_branch(value);
    // The other known lines contain the name of a test, functions (which programs do not have), and totals of
    // the counts.
    for (const std::string_view known : {"TN", "LF", "LH", "BRF", "BRH", "FNF", "FNH"}) {
      if (word == known) return;
    }
    if (!text.empty()) refuse(text, "a line of a tracefile that --coverage has written");
  }

  CoverageReport finish() {
    if (lines_ != nullptr) {
      fail("the file ends too early; expected end_of_record");
    }
    return std::move(report_);
  }

 private:
  [[noreturn]] void refuse(std::string_view what, const std::string& expected) const {
    fail(understudy::quoted(what) + " is not understood; expected " + expected);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(file_ + ":" + std::to_string(line_) + ": " + what);
  }

  void begin_record(std::string_view path) {
    if (lines_ != nullptr) refuse("SF:", "end_of_record before the next file");
    if (path.empty()) refuse("SF:", "a path after it");
    lines_ = &report_.files[std::string(path)].lines;
  }
  void end_record() {
    if (lines_ == nullptr) refuse("end_of_record", "SF: with a path before it");
    lines_ = nullptr;
  }

  CoveredLine& line_called(std::string_view number, std::string_view whole) {
    if (lines_ == nullptr) refuse(whole, "SF: with a path before it");
    const auto line = parse_integer(number);
    if (!line || *line < 1 || *line > std::numeric_limits<int>::max()) refuse(whole, "a line's number");
    return (*lines_)[static_cast<int>(*line)];
  }
  std::int64_t require_count(std::string_view count, std::string_view whole) const {
    const auto number = parse_integer(count);
    if (!number || *number < 0 || *number > kMaxCount) refuse(whole, "a count");
    return *number;
  }

  void take_line(std::string_view value) {
    const auto fields = fields_of(value);  // a checksum may follow
    if (fields.size() < 2) refuse(value, "DA:LINE,COUNT");
    const std::int64_t count = require_count(fields[1], value);
    line_called(fields[0], value).runs += count;
  }
  void take_branch(std::string_view value) {
    const auto fields = fields_of(value);
    const bool is_ours = fields.size() == 4 && fields[1] == "0" && (fields[2] == "0" || fields[2] == "1");
    if (!is_ours) refuse(value, "BRDA:LINE,0,BRANCH,COUNT with branch 0 or 1");
    const std::int64_t count = fields[3] == "-" ? 0 : require_count(fields[3], value);
    CoveredLine& line = line_called(fields[0], value);
    line.decides = true;
    (fields[2] == "0" ? line.yes : line.no) += count;
  }

  const std::string& file_;
  int line_ = 0;
  CoverageReport report_;
  CoveredLines* lines_ = nullptr;  // the current record's lines; null between records
};

}  // namespace

CoverageReport read_tracefile(std::string_view text, const std::string& file) {
  TracefileReader reader(file);
  for (const TextLine line : TextLines(without_byte_order_mark(text))) reader.take(line);
  return reader.finish();
}

}  // namespace understudy::emulator::world
