// A Modbus master for a real controller. It can only read: there is no function here that writes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "emulator/box/asking/asked.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/stages/executor.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

struct ReadReply {
  Asked asked;
  play::HostReply reply;
  int other_station = -1;  // a station that was not asked has answered
};

class ModbusMaster {
 public:
  struct Settings {
    int station = 1;
    WallTime timeout{0};
    WallTime silence{0};  // before each request
    bool is_tcp = false;  // Modbus TCP: a header instead of a checksum
  };
  ModbusMaster(Wire& wire, const Settings& settings) : wire_(wire), settings_(settings) {}

  ReadReply read(Table table, std::uint16_t first, int count);

 private:
  Bytes exchange(const Bytes& request, Asked& asked);
  Bytes exchange_tcp(const Bytes& request, Asked& asked);

  Wire& wire_;
  Settings settings_;
  WallTime quiet_since_{0};
  std::uint16_t transaction_ = 0;
};

}  // namespace understudy::emulator::box
