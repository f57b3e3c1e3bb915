// Collects everything that is wrong with a file, for readers that continue after a part that they cannot
// read.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/device/program_error.h"
#include "emulator/world/bench/inline_text.h"

namespace understudy::emulator::world {

/// Ends the reading, because what follows would be wrong for the same reason. It passes through every
/// attempt().
struct LastError : FileError {
  using FileError::FileError;
};

/// Converts the mistakes of a program to an error about the program's own file.
FileError program_diagnostics(const ProgramError& error, const std::string& file);
/// Converts the mistakes of a program inside a file.
FileError program_diagnostics(const ProgramError& error, const InlineText& text);

/// Thrown if a part that is referred to could not be read. That error has been reported already.
struct AlreadyReported {};

class Diagnostics {
 public:
  static constexpr std::size_t kMaxReported = 20;

  /// Returns true if `read` succeeded. If it did not, keeps its error.
  template <typename Read>
  bool attempt(const Read& read) {
    try {
      read();
      return true;
    } catch (const LastError& error) {
      add(error);
      throw;
    } catch (const FileError& error) {
      add(error);
    } catch (const AlreadyReported&) {
    }
    return false;
  }
  /// Attempts `read`, and throws all errors so far.
  template <typename Read>
  void require(const Read& read) {
    try {
      attempt(read);
    } catch (const LastError&) {  // already added
    }
    throw_if_any();
  }
  /// Adds an error, with `suffix` appended to each line, unless it has been reported already. Throws
  /// LastError if there are too many.
  void add(const FileError& error, const std::string& suffix = "");
  std::size_t count() const { return diagnostics_.size(); }
  /// If there are errors, throws a FileError with the first ones in the order of the file; several files keep
  /// the order in which they were reported.
  void throw_if_any() const;

 private:
  static constexpr std::size_t kMaxKept = 1000;

  std::vector<FileError::Diagnostic> diagnostics_;
  std::set<std::string> reported_;
  std::size_t more_ = 0;  // errors that the reports of parts left out
};

}  // namespace understudy::emulator::world
