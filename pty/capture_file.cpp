#include "pty/capture_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "pty/capture_pcapng.h"
#include "pty/capture_text.h"

namespace understudy::pty {
namespace {

constexpr std::size_t kMostWaiting = 4
                                     << 20;  // bytes; over a minute of a line at 115200 baud that never rests

std::string error_text(int error) { return std::generic_category().message(error); }

/// Open and empty, and ours alone.
Descriptor open_file(const std::string& path) {
  const auto refuse = [&path](const std::string& what) -> CaptureError {
    return CaptureError(path + ": the capture cannot be written: " + what);
  };
  // Not emptied before it is plain what it is; and a pipe that nobody reads is no reason to wait.
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666));
  const std::string expected = "it is no regular file; expected one, or a free path";
  if (!file) throw refuse(errno == EISDIR || errno == ENXIO ? expected : error_text(errno));
  struct stat status = {};
  if (::fstat(file.get(), &status) != 0) throw refuse(error_text(errno));
  if (!S_ISREG(status.st_mode)) throw refuse(expected);
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw refuse("another one is being written there; expected a path of its own");
  }
  if (::ftruncate(file.get(), 0) != 0) throw refuse(error_text(errno));
  return file;
}

}  // namespace

CaptureFile::CaptureFile(const std::string& path, std::vector<CapturedLine> lines,
                         std::function<void(const std::string&)> log)
    : path_(path),
      is_pcapng_(path.ends_with(".pcapng")),
      lines_(std::move(lines)),
      log_(std::move(log)),
      file_(open_file(path)),
      lost_before_(lines_.size()) {
  if (is_pcapng_) {
    append_pcapng_head(piece_, lines_);
  } else {
    append_text_head(piece_);
  }
  // At once: a capture that nothing can be written to should not start.
  if (const int error = write(piece_); error != 0) {
    throw CaptureError(path_ + ": the capture cannot be written: " + error_text(error));
  }
  writer_ = std::make_unique<BackgroundWriter>(kMostWaiting,
                                               [this](std::string_view bytes) { return write(bytes); });
}

CaptureFile::~CaptureFile() { finish(); }

void CaptureFile::add(const CapturedPacket& packet) {
  std::uint64_t& lost_before = lost_before_[packet.line];
  piece_.clear();
  if (is_pcapng_) {
    append_pcapng_packet(piece_, packet, lost_before);
  } else {
    append_text_packet(piece_, lines_, packet, lost_before);
  }
  const auto outcome = writer_->append(piece_);
  if (outcome == BackgroundWriter::Outcome::taken) {
    lost_before = 0;
    return;
  }
  ++lost_before;
  ++lost_;
  if (outcome == BackgroundWriter::Outcome::failed) {
    tell_failure();
  } else if (!std::exchange(has_told_slow_, true)) {
    log_(path_ + ": the disk is too slow, packets are missing from the capture");
  }
}

void CaptureFile::tell_failure() {
  const int error = writer_->failure().error;
  if (error == 0 || std::exchange(has_told_failure_, true)) return;
  log_(path_ + ": the capture has ended early: " + error_text(error));
}

void CaptureFile::finish() {
  if (!file_) return;
  writer_->finish();
  tell_failure();
  if (lost() > 0) log_(path_ + ": " + std::to_string(lost()) + " packets are missing from the capture");
  file_.close();
}

/// A packet is one write, so that whoever reads meanwhile, and a kill, find whole ones.
int CaptureFile::write(std::string_view piece) {
  const std::uint64_t end = written_ + piece.size();
  while (!piece.empty()) {
    const ssize_t size = ::write(file_.get(), piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) {
      const int error = errno;
      // Half a packet would make what came before unreadable.
      [[maybe_unused]] const int ignored = ::ftruncate(file_.get(), static_cast<off_t>(written_));
      return error;
    }
    piece.remove_prefix(static_cast<std::size_t>(size));
  }
  written_ = end;
  return 0;
}

}  // namespace understudy::pty
