// A Modbus master for a real controller. It can only read: there is no function here that writes.
#pragma once

#include <cstdint>

#include "emulator/box/asking/asked.h"
#include "emulator/box/asking/modbus_exchange.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/executors/executor.h"

namespace understudy::emulator::box {

struct ReadReply {
  Asked asked;
  play::HostReply reply;
  int other_station = -1;  // a station that was not asked has answered
};

class ModbusMaster {
 public:
  using Settings = ModbusExchange::Settings;
  ModbusMaster(Wire& wire, const Settings& settings)
      : exchange_(wire, settings), station_(settings.station) {}

  ReadReply read(Table table, std::uint16_t first, int count);

 private:
  ModbusExchange exchange_;
  int station_;
};

}  // namespace understudy::emulator::box
