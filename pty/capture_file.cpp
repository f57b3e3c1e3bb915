#include "pty/capture_file.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/background_writer.h"
#include "base/files/content_kind.h"
#include "base/files/output_file.h"
#include "pty/capture.h"
#include "pty/capture_pcapng.h"
#include "pty/capture_text.h"

namespace understudy::pty {
namespace {

constexpr std::size_t kMaxWaiting = 4 << 20;  // bytes; over a minute of a line at 115200 baud without pauses

[[noreturn]] void refuse(const std::string& path, const OutputError& error) {
  throw CaptureError(path + ": the capture cannot be written: " + error.what());
}

OutputFile open_file(const std::string& path) {
  try {
    return OutputFile(path, ContentKind::capture);
  } catch (const OutputError& error) {
    refuse(path, error);
  }
}

}  // namespace

CaptureFile::CaptureFile(const std::string& path, std::function<void(const std::string&)> log)
    : path_(path), is_pcapng_(path.ends_with(".pcapng")), log_(std::move(log)), file_(open_file(path)) {}

void CaptureFile::begin(std::vector<CapturedLine> lines) {
  lines_ = std::move(lines);
  lost_before_.resize(lines_.size());
  if (is_pcapng_) {
    append_pcapng_head(piece_, lines_);
  } else {
    append_text_head(piece_, lines_);
  }
  try {
    file_.begin(piece_);
  } catch (const OutputError& error) {
    refuse(path_, error);
  }
  // Each packet is one write, so that a reader finds whole packets at any time, even after a kill.
  writer_ = std::make_unique<BackgroundWriter>(kMaxWaiting,
                                               [this](std::string_view bytes) { return file_.write(bytes); });
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
    report_failure();
  } else if (!std::exchange(has_reported_slow_, true)) {
    log_(path_ + ": the disk is too slow; packets are missing from the capture");
  }
}

void CaptureFile::report_failure() {
  const int error = writer_->failure().error;
  if (error == 0 || !failure_.empty()) return;
  failure_ = path_ + ": the capture ended early: " + std::generic_category().message(error);
  log_(failure_);
}

void CaptureFile::finish() {
  if (!writer_ || std::exchange(is_finished_, true)) return;
  writer_->finish();
  report_failure();
  if (lost() > 0) log_(path_ + ": " + std::to_string(lost()) + " packets are missing from the capture");
}

}  // namespace understudy::pty
