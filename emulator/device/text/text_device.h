// A device without registers, spoken to in lines of text. A model's device is made of this, and says the
// rest: power, phases of a tick, terminals, axes, its state, and what it says to what it hears.
#pragma once

#include <span>

#include "emulator/device/device.h"
#include "emulator/device/text/text_speaker.h"

namespace understudy::emulator {

class TextDevice : public Device, public TextSpeaker {
 public:
  using Device::Device;

  TextSpeaker* speaker() final { return this; }
  const TextSpeaker* speaker() const final { return this; }
};

inline constexpr int kTextBauds[] = {9600};

constexpr PortRow port_of_text(std::span<const int> bauds = kTextBauds) {
  return {.kind = PortRow::Kind::rs232,
          .name = "RS232",
          .bauds = bauds,
          .settings = {.data_bits = 8, .parity = pty::Parity::none, .stop_bits = 1}};
}
inline constexpr PortRow kTextPort[] = {port_of_text()};

/// The line of such a model: it has one port, and no station number.
constexpr LineRules line_of_text(std::span<const PortRow, 1> port = kTextPort) {
  return {.protocol = kTextLines, .ports = port};
}

}  // namespace understudy::emulator
