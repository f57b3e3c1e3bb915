// Captures the traffic of all lines of a world in a file.
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
  /// Opens the file as pty/capture_file.h does; its old content stays until begin(). The world must outlive
  /// it. Throws pty::CaptureError.
  WorldCapture(World& world, const std::string& path, std::function<void(const std::string&)> log);
  ~WorldCapture();  // incomplete packets end here
  WorldCapture(const WorldCapture&) = delete;
  WorldCapture& operator=(const WorldCapture&) = delete;

  /// Starts at this moment. Throws pty::CaptureError.
  void begin();
  /// Waits until everything is written. Returns why the file ended early, or an empty string.
  std::string finish();

 private:
  World& world_;
  bool names_ports_;  // a text log shows only the line's name, as one word
  pty::CaptureFile file_;
  std::vector<std::unique_ptr<pty::CaptureFrames>> lines_;
};

}  // namespace understudy::emulator::world
