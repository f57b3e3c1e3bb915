// The file of `hunt --corpus`. It contains courses that reached something new, and the progress of the hunts
// with each seed.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/hunt/course.h"
#include "emulator/hunt/hunt.h"

namespace understudy::emulator::command_line {

class CorpusFile {
 public:
  /// Reads the file. An empty path means that there is no file. Throws FileError if the file is not a corpus.
  explicit CorpusFile(const std::string& path);

  bool is_wanted() const { return !path_.empty(); }
  std::uint64_t next_course(std::uint64_t seed) const;
  const std::vector<hunt::Course>& courses() const { return courses_; }
  /// Writes the unchanged file, to find out whether it can be written. Throws GrowingFileError.
  void try_to_write();
  /// Replaces the courses that were read with the courses of the hunt. Keeps lines that other hunts have
  /// written meanwhile. Throws FileError if the file is no longer a corpus, and GrowingFileError.
  void write(const hunt::Hunt& hunt, std::uint64_t seed);

 private:
  std::vector<hunt::Course> read_new();
  void write_with(const std::vector<hunt::Course>& own);

  std::string path_;
  std::map<std::uint64_t, std::uint64_t> next_;  // the number of the next course of each seed
  std::vector<hunt::Course> courses_;            // as read at the beginning
  std::set<std::string, std::less<>> known_;     // lines of courses that were read or written
  std::vector<std::string> of_others_;           // lines that other hunts have written meanwhile
};

}  // namespace understudy::emulator::command_line
