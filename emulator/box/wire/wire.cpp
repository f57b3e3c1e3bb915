#include "emulator/box/wire/wire.h"

#include <memory>

#include "emulator/box/wire/port_name.h"
#include "emulator/box/wire/serial_wire.h"
#include "emulator/box/wire/tcp_wire.h"

namespace understudy::emulator::box {

void Wire::discard() {
  Bytes none;
  while (receive(none, WallTime{0})) none.clear();
}

std::unique_ptr<Wire> open_wire(const PortName& name, WireUse use) {
  if (name.tcp) return std::make_unique<TcpWire>(*name.tcp);
  return std::make_unique<SerialWire>(name.place, use);
}

}  // namespace understudy::emulator::box
