#include "emulator/model_file/csv.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/lines.h"
#include "base/text/one_line.h"

namespace understudy::emulator::model_file {

namespace {

std::string without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin));
}

/// Returns the most frequent separator in the first line that contains a separator. Titles contain none.
char separator_of(std::string_view text) {
  constexpr int kMaxTitles = 20;
  for (int line = 0; line < kMaxTitles && !text.empty(); ++line) {
    const std::string_view first = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(first.size() + 1, text.size()));
    char max = '\0';
    std::ptrdiff_t count = 0;
    for (const char separator : {',', ';', '\t'}) {
      const auto here = std::count(first.begin(), first.end(), separator);
      if (here > count) max = separator;
      count = std::max(count, here);
    }
    if (max != '\0') return max;
  }
  return ',';
}

class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  std::vector<CsvRow> read() {
    if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
    line_begin_ = at_;
    std::vector<CsvRow> rows;
    while (at_ < text_.size()) {
      const std::string_view line = rest_of_line();
      const std::string first = without_blanks(line);
      if (first.empty() || first.front() == '#') {
        skip_line(line);
        continue;
      }
      if (separator_ == '\0') separator_ = separator_of(text_.substr(at_));
      rows.push_back(read_row());
    }
    return rows;
  }

 private:
  std::string_view rest_of_line() const { return text_.substr(at_, text_.find('\n', at_) - at_); }
  bool is_at_end_of_line() const { return at_ >= text_.size() || text_[at_] == '\n'; }

  void skip_line(std::string_view line) {
    at_ += line.size() + 1;
    begin_line();
  }
  void begin_line() {
    ++line_;
    line_begin_ = at_;
  }

  CsvRow read_row() {
    CsvRow row{.line = line_, .cells = {}};
    while (true) {
      row.cells.push_back(read_cell());
      if (is_at_end_of_line()) break;
      ++at_;  // the separator
    }
    ++at_;
    begin_line();
    return row;
  }

  CsvCell read_cell() {
    while (!is_at_end_of_line() && text_[at_] == ' ') ++at_;
    CsvCell cell{.text = {}, .column = static_cast<int>(at_ - line_begin_) + 1};
    if (!is_at_end_of_line() && text_[at_] == '"') {
      cell.text = read_quoted(cell.column);
      require_end_of_cell();
      return cell;
    }
    const std::size_t begin = at_;
    while (!is_at_end_of_line() && text_[at_] != separator_) ++at_;
    cell.text = without_blanks(text_.substr(begin, at_ - begin));
    return cell;
  }

  void require_end_of_cell() {
    const std::size_t begin = at_;
    while (!is_at_end_of_line() && text_[at_] != separator_) ++at_;
    const std::string more = without_blanks(text_.substr(begin, at_ - begin));
    if (more.empty()) return;
    throw FileError({file_, line_, static_cast<int>(begin - line_begin_) + 1},
                    "registers: " + quoted(more) + " follows a quoted cell; expected a separator");
  }

  /// Reads a quoted field. Two quotes within it stand for one.
  std::string read_quoted(int column) {
    const int line = line_;
    std::string text;
    for (++at_; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') {
          ++at_;
          return without_blanks(text);
        }
        ++at_;
      }
      text += c == '\n' ? ' ' : c;
      if (c != '\n') continue;
      ++line_;
      line_begin_ = at_ + 1;
    }
    throw FileError({file_, line, column}, "registers: a quoted cell is not closed; expected a second \"");
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  int line_ = 1;
  char separator_ = '\0';
};

}  // namespace

std::vector<CsvRow> parse_csv(const std::string& text, const std::string& file) {
  // Some spreadsheets on a Mac end lines with carriage returns alone, and other programs may add a line feed.
  const auto feeds = std::count(text.begin(), text.end(), '\n');
  std::ptrdiff_t alone = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    alone += text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n') ? 1 : 0;
  if (alone == 0 || alone < feeds) return CsvReader(text, file).read();
  std::string lines = text;
  std::ranges::replace(lines, '\r', '\n');
  return CsvReader(lines, file).read();
}

}  // namespace understudy::emulator::model_file
