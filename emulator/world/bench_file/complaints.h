// Everything that is wrong with a file, for readers that can go on after a part that they could not read.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/device/program_error.h"

namespace understudy::emulator::world {

/// Ends the reading: what follows would be wrong for the same reason. Passes through every attempt().
struct LastError : FileError {
  using FileError::FileError;
};

/// What is wrong with a program, about its own file.
FileError program_complaints(const ProgramError& error, const std::string& file);

/// What a part refers to could not be read, which has been reported already.
struct Untold {};

class Complaints {
 public:
  static constexpr std::size_t kMostTold = 20;

  /// Whether a part could be read; what is wrong with it is kept.
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
    } catch (const Untold&) {
    }
    return false;
  }
  /// Attempts all of it, and throws everything that was wrong.
  template <typename Read>
  void demand(const Read& read) {
    try {
      attempt(read);
    } catch (const LastError&) {  // it is among them
    }
    throw_if_any();
  }
  /// Reports nothing twice. `behind` is added to each. Throws a LastError if there are too many.
  void add(const FileError& error, const std::string& behind = "");
  std::size_t count() const { return complaints_.size(); }
  /// Throws a FileError with the first of them, in the file's order: the files as they came.
  void throw_if_any() const;

 private:
  static constexpr std::size_t kMostKept = 1000;

  std::vector<FileError::Complaint> complaints_;
  std::set<std::string> told_;
};

}  // namespace understudy::emulator::world
