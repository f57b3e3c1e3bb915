#include "emulator/command_line/corpus_file.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/descriptor.h"
#include "base/files/file_error.h"
#include "base/files/growing_file.h"
#include "base/files/text_file.h"
#include "emulator/hunt/corpus.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/hunt.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;

/// Locks the folder of a file, so that hunts with the same corpus write it one after another. A lock on the
/// file itself would not last, because the file is replaced each time. Some network folders do not support
/// locks; there, the last writer wins.
Descriptor locked_folder_of(const std::string& path) {
  const fs::path folder = fs::absolute(path).parent_path();
  Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor) ::flock(descriptor.get(), LOCK_EX);
  return descriptor;
}

}  // namespace

CorpusFile::CorpusFile(const std::string& path) : path_(path) {
  if (!path_.empty()) courses_ = read_new();
}

/// Returns the new courses in the file.
std::vector<hunt::Course> CorpusFile::read_new() {
  std::vector<hunt::Course> courses;
  if (!fs::exists(path_)) return courses;
  const FileText file = read_text_file(path_);
  if (!file) throw FileError(path_ + ": corpus: " + file.why + "; expected the corpus of a hunt");
  std::istringstream lines(*file);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    auto parsed = hunt::parse_corpus_line(line);
    if (!parsed) throw FileError({path_, number, 1}, "corpus: is not a line of a corpus; expected a course");
    if (parsed->course) {
      if (known_.insert(hunt::json_text(*parsed->course)).second)
        courses.push_back(*std::move(parsed->course));
    } else {
      std::uint64_t& next = next_[parsed->seed];
      next = std::max(next, parsed->next);
    }
  }
  return courses;
}

std::uint64_t CorpusFile::next_course(std::uint64_t seed) const {
  const auto it = next_.find(seed);
  return it == next_.end() ? 0 : it->second;
}

void CorpusFile::write_with(const std::vector<hunt::Course>& own) {
  const Descriptor lock = locked_folder_of(path_);
  for (const hunt::Course& course : read_new()) of_others_.push_back(hunt::json_text(course));
  std::string text;
  for (const auto& [seed, next] : next_) text += hunt::json_text(seed, next) + "\n";
  std::set<std::string> written;
  const auto add = [&](std::string line) {
    if (written.insert(line).second) text += line + "\n";
    known_.insert(std::move(line));
  };
  for (const hunt::Course& course : own) add(hunt::json_text(course));
  for (const std::string& line : of_others_) add(line);
  const std::string why = replace_text_file(path_, text, ContentKind::other);
  if (!why.empty()) throw GrowingFileError("--corpus: " + path_ + " cannot be written: " + why);
}

void CorpusFile::try_to_write() {
  if (is_wanted()) write_with(courses_);
}

void CorpusFile::write(const hunt::Hunt& hunt, std::uint64_t seed) {
  std::uint64_t& next = next_[seed];
  next = std::max(next, hunt.next_course());
  std::vector<hunt::Course> own;
  for (const hunt::Seed& one : hunt.corpus().seeds()) own.push_back(one.course);
  own.insert(own.end(), hunt.unplayed().begin(), hunt.unplayed().end());
  write_with(own);
}

}  // namespace understudy::emulator::command_line
