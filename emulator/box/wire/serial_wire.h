// A serial port of this machine.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/files/descriptor.h"
#include "emulator/box/wire/wire.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

class SerialWire final : public Wire {
 public:
  SerialWire(std::string path, WireUse use);
  void set_line(const pty::LineSettings& settings) override;
  void send(std::span<const std::uint8_t> bytes) override;
  bool receive(Bytes& bytes, WallTime until) override;
  int descriptor() const override { return port_.get(); }

 private:
  std::string path_;
  Descriptor port_;
};

}  // namespace understudy::emulator::box
