#include "emulator/box/asking/modbus_master.h"

#include <cstdint>

#include "emulator/box/wire/wire.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/executors/modbus_host.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

ReadReply ModbusMaster::read(Table table, std::uint16_t first, int count) {
  ReadReply result;
  result.asked = exchange_.ask(play::read_request(station_, table, first, count));
  const Bytes& request = result.asked.request;
  const Bytes& reply = result.asked.reply;
  result.reply = play::judge_reply(request, reply);
  if (reply.size() > 2 && reply[0] != request[0] && pty::rtu_crc_ok(reply)) result.other_station = reply[0];
  return result;
}

}  // namespace understudy::emulator::box
