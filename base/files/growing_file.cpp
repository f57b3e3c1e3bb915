#include "base/files/growing_file.h"

#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/files/content_kind.h"
#include "base/files/output_file.h"

namespace understudy {

namespace {

constexpr std::size_t kMaxWaiting = 16 << 20;  // bytes

[[noreturn]] void refuse(const std::string& path, const std::string& what, const OutputError& error) {
  throw GrowingFileError(path + ": " + what + " cannot be written: " + error.what());
}

OutputFile open_file(const std::string& path, ContentKind kind, const std::string& what) {
  try {
    return OutputFile(path, kind);
  } catch (const OutputError& error) {
    refuse(path, what, error);
  }
}

}  // namespace

GrowingFile::GrowingFile(const std::string& path, ContentKind kind,
                         std::function<void(const std::string&)> log)
    : path_(path), what_(the(kind)), log_(std::move(log)), file_(open_file(path, kind, what_)) {}

GrowingFile::~GrowingFile() { finish(); }

void GrowingFile::take(std::string_view line) {
  if (!failure_.empty()) return;
  if (!has_begun_) return begin(line);
  if (!writer_) return;
  switch (writer_->append(line)) {
    case BackgroundWriter::Outcome::taken: return;
    case BackgroundWriter::Outcome::full: return give_up("the disk is too slow");
    case BackgroundWriter::Outcome::failed: return give_up(std::strerror(writer_->failure().error));
  }
}

void GrowingFile::begin(std::string_view line) {
  try {
    file_.begin(line);
  } catch (const OutputError& error) {
    refuse(path_, what_, error);
  }
  has_begun_ = true;
  writer_ = std::make_unique<BackgroundWriter>(kMaxWaiting,
                                               [this](std::string_view piece) { return file_.write(piece); });
}

void GrowingFile::give_up(const std::string& why) {
  if (!failure_.empty()) return;
  failure_ = path_ + ": " + what_ + " ended early: " + why;
  if (log_) log_(failure_);
}

std::string GrowingFile::finish() {
  if (writer_) {
    writer_->finish();
    if (const int error = writer_->failure().error; error != 0) give_up(std::strerror(error));
    writer_.reset();
  }
  return failure_;
}

}  // namespace understudy
