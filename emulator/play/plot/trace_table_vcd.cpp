// Reads the value change dumps (IEEE 1364) that this program writes, and no other parts of the format.
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/play/plot/trace_table.h"

namespace understudy::emulator::play {

namespace {

class VcdReader {
 public:
  VcdReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  TraceTable read() {
    while (!has_header_) {
      const std::string_view word = next();
      if (word.empty()) fail("ends within its header; expected $enddefinitions");
      read_declaration(word);
    }
    for (std::string_view word = next(); !word.empty(); word = next()) read_change(word);
    end_row();
    table_.columns.resize(table_.names.size());
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(name_ + ":" + std::to_string(line_) + ": " + what);
  }

  /// Returns the next word, or an empty text at the end.
  std::string_view next() {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
    while (at_ < text_.size() && is_blank(text_[at_])) {
      if (text_[at_++] == '\n') ++line_;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// Returns the words up to $end.
  std::vector<std::string> words() {
    std::vector<std::string> words;
    for (std::string_view word = next(); word != "$end"; word = next()) {
      if (word.empty()) fail("ends within a declaration; expected $end");
      words.emplace_back(word);
    }
    return words;
  }

  void read_declaration(std::string_view keyword) {
    if (!keyword.starts_with("$")) fail(quoted(keyword) + " is not a declaration; expected one such as $var");
    const std::vector<std::string> message = words();
    if (keyword == "$timescale") {
      std::string scale;
      for (const std::string& word : message) scale += word;
      if (scale != "1ms") fail("$timescale: is " + quoted(scale) + "; expected 1 ms");
    } else if (keyword == "$scope") {
      if (message.size() != 2) fail("$scope: expected a kind and a name");
      scopes_.push_back(message[1]);
    } else if (keyword == "$upscope") {
      if (scopes_.empty()) fail("$upscope: there is no scope to leave");
      scopes_.pop_back();
    } else if (keyword == "$var") {
      if (message.size() < 4) fail("$var: expected a type, a size, a code and a name");
      std::string name;
      for (const std::string& scope : scopes_) name += scope + ".";
      codes_[message[2]] = table_.names.size();
      table_.names.push_back(name + message[3]);
      values_.push_back(0);
    } else if (keyword == "$enddefinitions") {
      has_header_ = true;
      table_.columns.resize(table_.names.size());
    }
  }

  void read_change(std::string_view word) {
    if (word.starts_with("$")) return;  // the changes within $dumpvars and similar keywords also count
    if (word.front() == '#') {
      end_row();
      Tick tick = 0;
      const auto read = std::from_chars(word.data() + 1, word.data() + word.size(), tick);
      if (read.ec != std::errc{} || read.ptr != word.data() + word.size()) {
        fail(quoted(word) + " is not a time; expected one such as #250");
      }
      if (has_row_ && tick <= tick_) fail(quoted(word) + " is not later than the previous time");
      tick_ = tick;
      has_row_ = true;
      return;
    }
    if (!has_row_) fail(quoted(word) + " comes before any time; expected a time such as #0 first");
    const bool is_scalar =
        word.front() == '0' || word.front() == '1' || word.front() == 'x' || word.front() == 'z';
    const std::string code(is_scalar ? word.substr(1) : next());
    const auto found = codes_.find(code);
    if (found == codes_.end()) fail(quoted(code) + " is not a variable's code; expected a declared one");
    values_[found->second] = is_scalar ? (word.front() == '1' ? 1 : 0) : value_of(word);
  }

  double value_of(std::string_view word) const {
    const std::string_view digits = word.substr(1);
    const char* const end = digits.data() + digits.size();
    if (word.front() == 'r') {
      double real = 0;
      const auto read = std::from_chars(digits.data(), end, real);
      if (read.ec == std::errc{} && read.ptr == end) return real;
    } else if (word.front() == 'b') {
      std::uint64_t bits = 0;
      const auto read = std::from_chars(digits.data(), end, bits, 2);
      if (read.ec == std::errc{} && read.ptr == end) {
        return static_cast<double>(static_cast<std::int64_t>(bits));
      }
    }
    fail(quoted(word) + " is not a value; expected one such as 1, b101 or r2.5");
  }

  void end_row() {
    if (!has_row_) return;
    table_.ticks.push_back(tick_);
    for (std::size_t i = 0; i < values_.size(); ++i) table_.columns[i].push_back(values_[i]);
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  TraceTable table_;
  std::vector<std::string> scopes_;
  std::map<std::string, std::size_t> codes_;
  std::vector<double> values_;  // the current values
  Tick tick_ = 0;
  bool has_row_ = false;
  bool has_header_ = false;
};

}  // namespace

TraceTable parse_vcd_trace(std::string_view text, const std::string& name) {
  return VcdReader(text, name).read();
}

}  // namespace understudy::emulator::play
