#include "emulator/model_file/list_reading.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/files/file_error.h"

namespace understudy::emulator::model_file {

std::vector<FileError::Diagnostic> Remarks::all() const {
  std::vector<FileError::Diagnostic> made;
  for (const auto& [kind, reported] : all_) {
    const FilePlace& place = reported.first.place;
    const std::string suffix = reported.more == 0 ? "" : " (and " + std::to_string(reported.more) + " more)";
    made.push_back({place, place.file + ":" + std::to_string(place.line) + ":" +
                               std::to_string(place.column) + ": " + reported.first.text + suffix});
  }
  std::stable_sort(made.begin(), made.end(),
                   [](const auto& one, const auto& other) { return one.place.line < other.place.line; });
  return made;
}

}  // namespace understudy::emulator::model_file
