// What goes over all lines of a world, as a capture file.
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
  /// Opens the file, as pty/capture_file.h does; what is there stays until begin(). The world must outlive
  /// it. Throws pty::CaptureError.
  WorldCapture(World& world, const std::string& path, std::function<void(const std::string&)> log);
  ~WorldCapture();  // what waits for its end is a packet then
  WorldCapture(const WorldCapture&) = delete;
  WorldCapture& operator=(const WorldCapture&) = delete;

  /// From this moment on. Throws pty::CaptureError.
  void begin();
  /// Waits until all is written. Returns why it has ended early, or nothing.
  std::string finish();

 private:
  World& world_;
  bool names_ports_;  // a text log has a line's name as one word
  pty::CaptureFile file_;
  std::vector<std::unique_ptr<pty::CaptureFrames>> lines_;
};

}  // namespace understudy::emulator::world
