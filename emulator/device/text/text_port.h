// The line of a model with a text protocol, which has one port and no station number.
#pragma once

#include <span>

#include "emulator/device/model.h"
#include "emulator/device/text/text_protocol.h"

namespace understudy::emulator {

inline constexpr int kTextBauds[] = {9600};

constexpr PortRow port_of_text(std::span<const int> bauds = kTextBauds) {
  return {.kind = PortRow::Kind::rs232,
          .name = "RS232",
          .bauds = bauds,
          .settings = {.data_bits = 8, .parity = pty::Parity::none, .stop_bits = 1}};
}
inline constexpr PortRow kTextPort[] = {port_of_text()};

constexpr LineRules line_of_text(std::span<const PortRow, 1> port = kTextPort) {
  return {.protocol = kTextLines, .ports = port};
}

}  // namespace understudy::emulator
