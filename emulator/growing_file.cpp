#include "emulator/growing_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace understudy::emulator {

namespace {

constexpr std::size_t kMostWaiting = 16 << 20;  // bytes

}  // namespace

GrowingFile::GrowingFile(const std::string& path, std::string what,
                         std::function<void(const std::string&)> log)
    : path_(path),
      what_(std::move(what)),
      log_(std::move(log)),
      file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666)) {
  const auto refuse = [&](const std::string& why) {
    return GrowingFileError(path + ": " + what_ + " cannot be written: " + why);
  };
  struct stat status = {};
  if (!file_) throw refuse(std::strerror(errno));
  if (::fstat(file_.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    throw refuse("it is no regular file; expected one, or a free path");
  }
  if (::ftruncate(file_.get(), 0) != 0) throw refuse(std::strerror(errno));
  writer_ = std::make_unique<pty::BackgroundWriter>(kMostWaiting,
                                                    [this](std::string_view piece) { return write(piece); });
}

GrowingFile::~GrowingFile() { finish(); }

void GrowingFile::take(std::string_view line) {
  if (has_given_up_ || !writer_) return;
  switch (writer_->append(line)) {
    case pty::BackgroundWriter::Outcome::taken: return;
    case pty::BackgroundWriter::Outcome::full: return give_up("the disk is too slow");
    case pty::BackgroundWriter::Outcome::failed: return give_up(std::strerror(writer_->failure().error));
  }
}

void GrowingFile::give_up(const std::string& why) {
  if (std::exchange(has_given_up_, true) || !log_) return;
  log_(path_ + ": " + what_ + " has ended early: " + why);
}

void GrowingFile::finish() {
  if (!writer_) return;
  writer_->finish();
  if (const int error = writer_->failure().error; error != 0) give_up(std::strerror(error));
  writer_.reset();
}

int GrowingFile::write(std::string_view piece) {
  while (!piece.empty()) {
    const ssize_t size = ::write(file_.get(), piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return errno;
    piece.remove_prefix(static_cast<std::size_t>(size));
  }
  return 0;
}

}  // namespace understudy::emulator
