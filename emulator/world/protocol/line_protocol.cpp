#include "emulator/world/protocol/line_protocol.h"

#include <array>
#include <stdexcept>
#include <string>
#include "emulator/device/model.h"

namespace understudy::emulator::world {

const LineProtocol& protocol_of(const Model& model) {
  for (const LineProtocol* const protocol :
       std::array{&modbus_protocol(), &ascii_protocol(), &text_protocol()}) {
    if (&protocol->protocol() == &model.line.protocol) return *protocol;
  }
  throw std::logic_error(std::string(model.name) + ": no line of a world carries " +
                         std::string(model.line.protocol.name));
}

}  // namespace understudy::emulator::world
