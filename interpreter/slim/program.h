// The stored program: lines of text, each of which is parsed when it is entered. Operands that refer to a
// line or a label are looked up when the program runs. Lines are counted from 0 here, even if a host numbers
// them differently.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/options.h"

namespace understudy::interpreter::slim {

struct StoredLine {
  std::string text;  // as entered, without surrounding blanks
  ParsedLine parsed;
  // If lines are checked when they run, this is the error with which the line fails when it is reached. It
  // may have a label.
  Error error = Error::none;

  bool operator==(const StoredLine&) const = default;
};

class Program {
 public:
  int size() const { return static_cast<int>(lines_.size()); }
  const StoredLine& line(int number) const { return lines_[static_cast<std::size_t>(number)]; }

  /// `number` may be size(), to insert after the last line. insert() and replace() refuse the following and
  /// change nothing: a line that does not parse or is empty; a command that is not allowed in a program
  /// (not_allowed); a label that another line has (address); a number that does not exist (range); more lines
  /// than fit (buffer_full). If checks_as_run(), they refuse only empty lines, lines that are too long, and
  /// lines that end a transfer. If several lines then have the same label, the first one is valid and the
  /// others fail with `address`, regardless of the order in which they were entered.
  Error insert(int number, std::string_view text, const Options& options = {});
  Error replace(int number, std::string_view text, const Options& options = {});
  Error remove(int number, const Options& options = {});
  void clear() { lines_.clear(); }

  /// Returns the line to which an address (a label or a number) refers. If two labels are equal, the first
  /// one counts.
  std::optional<int> find(const Operand& address, const Options& options = {}) const;

  /// Returns the lines for `PL`.
  std::vector<std::string> listing(const Options& options = {}) const;
  /// Returns the lines for `ULP`: all lines, then END.
  std::vector<std::string> upload() const;

  /// Save and restore the program. set_texts() returns false for texts that no program can have, and does not
  /// change the program in this case.
  std::vector<std::string> texts() const;
  bool set_texts(const std::vector<std::string>& texts, const Options& options = {});

  bool operator==(const Program&) const = default;

 private:
  /// What `text` would become in place of line `replaced`, or as an additional line if `replaced` is -1.
  struct Checked {
    Error error = Error::none;
    StoredLine line = {};
  };
  Checked check(std::string_view text, int replaced, const Options& options) const;
  static Checked check_alone(std::string_view text, const Options& options);
  static Checked failing(Checked checked, std::string_view text);
  void judge_label(const std::string& label, const Options& options);
  std::vector<StoredLine> lines_;
};

}  // namespace understudy::interpreter::slim
