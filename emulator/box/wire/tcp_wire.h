// A serial port behind TCP: plain bytes (also those of Modbus TCP), or RFC 2217 with settings.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/files/descriptor.h"
#include "emulator/box/wire/wire.h"
#include "emulator/serve/ports/telnet.h"
#include "emulator/world/bench/listening.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

class TcpWire final : public Wire {
 public:
  explicit TcpWire(const world::TcpAddress& address);
  void set_line(const pty::LineSettings& settings) override;
  void send(std::span<const std::uint8_t> bytes) override;
  bool receive(Bytes& bytes, WallTime until) override;
  int descriptor() const override { return socket_.get(); }

 private:
  void offer();
  void answer(const serve::telnet::Command& command);
  void read_raw(Bytes& data, WallTime until);

  std::string place_;
  bool is_telnet_;
  Descriptor socket_;
  serve::telnet::Reader reader_;
  bool has_com_port_ = false;  // the adapter has agreed to set the port
  bool refuses_com_port_ = false;
  int settings_confirmed_ = 0;  // answers to SET-BAUDRATE
};

}  // namespace understudy::emulator::box
