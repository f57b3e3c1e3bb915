#include "emulator/world/bench_file/complaints.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/device/mistakes_told.h"
#include "emulator/device/program_error.h"

namespace understudy::emulator::world {

FileError program_complaints(const ProgramError& error, const std::string& file) {
  std::vector<FileError::Complaint> complaints;
  for (const ProgramMistake& mistake : with_word_of_more(error.mistakes)) {
    complaints.push_back({.place = {.file = file, .line = mistake.line, .column = mistake.column},
                          .text = one_line(in_file(mistake, file))});
  }
  return FileError(std::move(complaints));
}

void Complaints::add(const FileError& error, const std::string& behind) {
  for (FileError::Complaint complaint : error.complaints()) {
    if (!told_.insert(complaint.text).second) continue;
    complaint.text += behind;
    complaints_.push_back(std::move(complaint));
  }
  if (complaints_.size() >= kMaxKept) throw LastError(std::vector<FileError::Complaint>());
}

void Complaints::throw_if_any() const {
  if (complaints_.empty()) return;
  std::map<std::string, std::size_t> files;  // in the order in which they came
  for (const FileError::Complaint& complaint : complaints_) files.emplace(complaint.place.file, files.size());
  const auto place = [&](const FileError::Complaint& complaint) {
    return std::tuple(files[complaint.place.file], complaint.place.line, complaint.place.column);
  };
  std::vector<FileError::Complaint> sorted = complaints_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto& left, const auto& right) { return place(left) < place(right); });
  if (sorted.size() > kMaxTold) {
    const std::size_t more = sorted.size() - kMaxTold;
    sorted.resize(kMaxTold);
    const FileError rest("and " + std::to_string(more) + " more; the first " + std::to_string(kMaxTold) +
                         " are shown");
    sorted.push_back(rest.complaints().front());
  }
  throw FileError(std::move(sorted));
}

}  // namespace understudy::emulator::world
