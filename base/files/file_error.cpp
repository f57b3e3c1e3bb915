#include "base/files/file_error.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/text/one_line.h"

namespace understudy {

namespace {

std::vector<FileError::Complaint> alone(FilePlace place, const std::string& text) {
  std::vector<FileError::Complaint> complaints(1);
  complaints.front().place = std::move(place);
  complaints.front().text = one_line(text);
  return complaints;
}

std::string joined(const std::vector<FileError::Complaint>& complaints) {
  std::string lines;
  for (const FileError::Complaint& complaint : complaints) {
    lines += (lines.empty() ? "" : "\n") + complaint.text;
  }
  return lines;
}

std::string to_text(const FilePlace& place) {
  return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": ";
}

}  // namespace

FileError::FileError(const std::string& text) : FileError(alone({}, text)) {}

FileError::FileError(const FilePlace& place, const std::string& text)
    : FileError(alone(place, to_text(place) + text)) {}

FileError::FileError(std::vector<Complaint> complaints)
    : std::runtime_error(joined(complaints)), complaints_(std::move(complaints)) {}

}  // namespace understudy
