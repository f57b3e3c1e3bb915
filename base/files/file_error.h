#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace understudy {

/// Where in a file; both count from 1. Without a line it is the whole file.
struct FilePlace {
  std::string file;
  int line = 0;
  int column = 0;
};

/// What is wrong with a file that a user wrote. One line: "file:line:column: field: what is wrong; what was
/// expected". Or several such lines: everything that is wrong.
class FileError : public std::runtime_error {
 public:
  struct Complaint {
    FilePlace place;
    std::string text;  // the whole line
  };

  explicit FileError(const std::string& text);
  FileError(const FilePlace& place, const std::string& text);
  explicit FileError(std::vector<Complaint> complaints);

  const std::vector<Complaint>& complaints() const { return complaints_; }

 private:
  std::vector<Complaint> complaints_;
};

}  // namespace understudy
