// Captures the traffic on all lines of a world in a file.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/world/world.h"
#include "pty/capture_file.h"
#include "pty/capture_frames.h"

namespace understudy::emulator::world {

class WorldCapture {
 public:
  /// Opens the file like pty/capture_file.h; its old content stays until begin(). The world must outlive this
  /// object. Throws pty::CaptureError.
  WorldCapture(World& world, const std::string& path, std::function<void(const std::string&)> log);
  ~WorldCapture();  // also ends incomplete packets
  WorldCapture(const WorldCapture&) = delete;
  WorldCapture& operator=(const WorldCapture&) = delete;

  /// Starts at this moment. Throws pty::CaptureError.
  void begin();
  /// Waits until everything is written. Returns why the file ended early, or an empty string if it did not.
  std::string finish();

 private:
  World& world_;
  bool names_ports_;  // false for a text log, which shows only the name of the line, as one word
  pty::CaptureFile file_;
  std::vector<std::unique_ptr<pty::CaptureFrames>> lines_;
};

}  // namespace understudy::emulator::world
