// What goes over all lines of a world, as a capture file.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/world/world.h"
#include "pty/capture_file.h"
#include "pty/capture_frames.h"

namespace understudy::emulator {

class WorldCapture {
 public:
  /// From this moment on; the world must outlive it. The file as pty/capture_file.h has it; throws
  /// pty::CaptureError.
  WorldCapture(World& world, const std::string& path, std::function<void(const std::string&)> log);
  ~WorldCapture();  // what waits for its end is a packet then
  WorldCapture(const WorldCapture&) = delete;
  WorldCapture& operator=(const WorldCapture&) = delete;

 private:
  World& world_;
  pty::CaptureFile file_;
  std::vector<std::unique_ptr<pty::CaptureFrames>> lines_;
};

}  // namespace understudy::emulator
