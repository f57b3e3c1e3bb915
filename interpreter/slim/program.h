// The stored program: lines of text, each parsed when it is entered. Operands that name a line or a label
// are looked up when the program runs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/parse.h"

namespace understudy::interpreter::slim {

inline constexpr int kProgramCapacity = 1000;

struct StoredLine {
  std::string text;  // as entered, without the blanks around it
  ParsedLine parsed;

  bool operator==(const StoredLine&) const = default;
};

class Program {
 public:
  int size() const { return static_cast<int>(lines_.size()); }
  const StoredLine& line(int number) const { return lines_[static_cast<std::size_t>(number)]; }

  /// Behind the last line: what insert() takes as a number.
  /// Refuses (and changes nothing): a line that does not parse, or is empty; a command that no program may
  /// hold (not_allowed); a number that there is not (range); more lines than fit (buffer_full).
  Error insert(int number, std::string_view text, const Dialect& dialect = {});
  Error replace(int number, std::string_view text, const Dialect& dialect = {});
  Error remove(int number);
  void clear() { lines_.clear(); }

  /// The line that an address (a label or a number) means. Of two equal labels the first counts.
  std::optional<int> find(const Operand& address) const;

  /// For `PL`: "0: MA 100".
  std::vector<std::string> listing() const;
  /// For `ULP`: the lines, then END.
  std::vector<std::string> upload() const;

  /// For saving and restoring. False for texts that no program can hold; the program is then unchanged.
  std::vector<std::string> texts() const;
  bool set_texts(const std::vector<std::string>& texts, const Dialect& dialect = {});

  bool operator==(const Program&) const = default;

 private:
  std::vector<StoredLine> lines_;
};

}  // namespace understudy::interpreter::slim
