// A capture as a file that grows while the world runs: pcapng or text, as its name says. Adding packets never
// waits for the disk, and the file consists of whole packets at every moment.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/files/background_writer.h"
#include "base/files/output_file.h"
#include "pty/capture.h"

namespace understudy::pty {

/// The file cannot be written. One line: what is wrong, what was expected.
struct CaptureError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class CaptureFile {
 public:
  /// `path` ends in .pcapng, or the capture is text. Opens it (output_file.h has which files may be); `log`
  /// gets a sentence when packets are lost; it is called by add() and finish() only. Throws CaptureError.
  CaptureFile(const std::string& path, std::function<void(const std::string&)> log);
  ~CaptureFile();  // finishes

  /// Deletes what was there before; from now on packets of these lines may be added. Throws CaptureError.
  void begin(std::vector<CapturedLine> lines);
  void add(const CapturedPacket& packet);

  /// Waits until all is written; nothing may be added afterwards.
  void finish();

  /// Packets that are not in the file: the disk was too slow, or full.
  std::uint64_t lost() const { return lost_ + (writer_ ? writer_->failure().lost : 0); }
  /// Why it has ended early; empty if it has not. Known at the end: after finish().
  const std::string& failure() const { return failure_; }

 private:
  void tell_failure();

  std::string path_;
  bool is_pcapng_;
  std::vector<CapturedLine> lines_;
  std::function<void(const std::string&)> log_;
  OutputFile file_;
  std::vector<std::uint64_t> lost_before_;  // of each line, since its last packet in the file
  std::uint64_t lost_ = 0;
  bool has_told_slow_ = false;
  std::string failure_;
  bool is_finished_ = false;
  std::string piece_;
  std::unique_ptr<BackgroundWriter> writer_;  // last: its thread uses the others
};

}  // namespace understudy::pty
