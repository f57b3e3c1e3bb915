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

/// Ends reading, because everything that follows would be wrong for the same reason. It passes through every
/// attempt().
struct LastError : FileError {
  using FileError::FileError;
};

/// Converts the mistakes in a program to an error about the file of the program.
FileError program_diagnostics(const ProgramError& error, const std::string& file);
/// Converts the mistakes in a program that is written within a file.
FileError program_diagnostics(const ProgramError& error, const InlineText& text);

/// Thrown if a reference leads to a part that could not be read. The error in that part was already reported.
struct AlreadyReported {};

class Diagnostics {
 public:
  static constexpr std::size_t kMaxReported = 20;

  /// Returns true if `read` succeeds. Otherwise, keeps its error.
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
    } catch (const LastError&) {  // the error was already added
    }
    throw_if_any();
  }
  /// Adds an error that has not been reported yet, with `suffix` appended to each line. Throws LastError if
  /// there are too many errors.
  void add(const FileError& error, const std::string& suffix = "");
  std::size_t count() const { return diagnostics_.size(); }
  /// If there are errors, throws a FileError that contains the first ones in the order of the file. If there
  /// are several files, they have the order in which they were reported.
  void throw_if_any() const;

 private:
  static constexpr std::size_t kMaxKept = 1000;

  std::vector<FileError::Diagnostic> diagnostics_;
  std::set<std::string> reported_;
  std::size_t more_ = 0;  // errors that the reports of parts omitted
};

}  // namespace understudy::emulator::world
