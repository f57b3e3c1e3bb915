// The stored program: lines of text, each parsed when it is entered. Operands that name a line or a label
// are looked up when the program runs. Lines are counted from 0 here, whatever numbers they have for a host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/slim/availability.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/parse.h"

namespace understudy::interpreter::slim {

/// What the manual leaves open about stored programs.
struct ProgramOptions {
  Dialect dialect = {};
  Columns columns = {};
  int capacity = 1000;   // lines
  int first_number = 0;  // of the first line: in addresses, in PE, PI, PD and PL
  /// A line that no program can carry out is refused as it is entered, or stored and refused as it runs.
  enum class Check : std::uint8_t { as_entered, as_run } check = Check::as_entered;
  /// What the machine knows about a command without its state, such as which parameters exist; null: nothing.
  Error (*check_command)(const Command& command) = nullptr;
  /// An empty line while a program is entered.
  enum class EmptyLine : std::uint8_t { ends_editing, is_ignored } empty_line = EmptyLine::ends_editing;
  /// A line that is refused after PE or PI: they wait for another one, or end.
  enum class RefusedLine : std::uint8_t {
    is_asked_for_again,
    ends_pe_and_pi
  } refused_line = RefusedLine::is_asked_for_again;
  /// A line with a label that another line has already: refused, or only the first one is ever found.
  enum class SameLabel : std::uint8_t { refused, first_counts } same_label = SameLabel::refused;
  /// What PL shows: "0: MA 100", or the line as it is.
  enum class Listing : std::uint8_t { numbered, bare } listing = Listing::numbered;

  bool operator==(const ProgramOptions&) const = default;
};

struct StoredLine {
  std::string text;  // as entered, without the blanks around it
  ParsedLine parsed;
  Error error =
      Error::none;  // of Check::as_run: what the line fails with when it is reached; it may have a label

  bool operator==(const StoredLine&) const = default;
};

class Program {
 public:
  int size() const { return static_cast<int>(lines_.size()); }
  const StoredLine& line(int number) const { return lines_[static_cast<std::size_t>(number)]; }

  /// Behind the last line: what insert() takes as a number. Refuses (and changes nothing): a line that does
  /// not parse, or is empty; a command that no program may hold (not_allowed); a label that another line has
  /// (address); a number that does not exist (range); more lines than fit (buffer_full). With Check::as_run
  /// only empty lines, those too long, and what ends a transfer are refused for what they say; of lines with
  /// one label the first is good, and the others fail with `address`, whichever was entered first.
  Error insert(int number, std::string_view text, const ProgramOptions& options = {});
  Error replace(int number, std::string_view text, const ProgramOptions& options = {});
  Error remove(int number, const ProgramOptions& options = {});
  void clear() { lines_.clear(); }

  /// The line that an address (a label or a number) means. Of two equal labels the first counts.
  std::optional<int> find(const Operand& address, const ProgramOptions& options = {}) const;

  /// For `PL`.
  std::vector<std::string> listing(const ProgramOptions& options = {}) const;
  /// For `ULP`: the lines, then END.
  std::vector<std::string> upload() const;

  /// For saving and restoring. False for texts that no program can hold; the program is then unchanged.
  std::vector<std::string> texts() const;
  bool set_texts(const std::vector<std::string>& texts, const ProgramOptions& options = {});

  bool operator==(const Program&) const = default;

 private:
  /// The line that `text` makes in place of line `replaced`; -1: in none's.
  struct Checked {
    Error error = Error::none;
    StoredLine line = {};
  };
  Checked check(std::string_view text, int replaced, const ProgramOptions& options) const;
  static Checked check_alone(std::string_view text, const ProgramOptions& options);
  static Checked failing(Checked checked, std::string_view text);
  void judge_label(const std::string& label, const ProgramOptions& options);
  std::vector<StoredLine> lines_;
};

}  // namespace understudy::interpreter::slim
