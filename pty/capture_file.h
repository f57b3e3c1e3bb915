// Writes a capture to a file while the world runs. The format, pcapng or text, follows from the file's name.
// Adding packets never waits for the disk, and the file consists of whole packets at every moment.
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

/// Thrown if the file cannot be written. The message is one line: what is wrong, and what was expected.
struct CaptureError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class CaptureFile {
 public:
  /// Opens the file. The format is pcapng if `path` ends in .pcapng, otherwise text. output_file.h has the
  /// rules about which files may be written. `log` receives a sentence when packets are lost; only add() and
  /// finish() call it. Throws CaptureError.
  CaptureFile(const std::string& path, std::function<void(const std::string&)> log);
  ~CaptureFile();  // finishes

  /// Deletes the old content. From now on packets of these lines may be added. Throws CaptureError.
  void begin(std::vector<CapturedLine> lines);
  void add(const CapturedPacket& packet);

  /// Waits until everything is written. Nothing may be added afterwards.
  void finish();

  /// The number of packets that are missing from the file because the disk was too slow or full.
  std::uint64_t lost() const { return lost_ + (writer_ ? writer_->failure().lost : 0); }
  /// The reason why the file ended early, or an empty string. Known only after finish().
  const std::string& failure() const { return failure_; }

 private:
  void report_failure();

  std::string path_;
  bool is_pcapng_;
  std::vector<CapturedLine> lines_;
  std::function<void(const std::string&)> log_;
  OutputFile file_;
  std::vector<std::uint64_t> lost_before_;  // the lost packets of each line since its last packet in the file
  std::uint64_t lost_ = 0;
  bool has_reported_slow_ = false;
  std::string failure_;
  bool is_finished_ = false;
  std::string piece_;
  std::unique_ptr<BackgroundWriter> writer_;  // declared last, because its thread uses the other members
};

}  // namespace understudy::pty
