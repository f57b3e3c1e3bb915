// A device without registers, spoken to in lines of text. A model's device is made of this, and says the
// rest: power, phases of a tick, terminals, axes, its state, and what it says to what it hears.
#pragma once

#include "emulator/device/device.h"
#include "emulator/device/text/text_speaker.h"

namespace understudy::emulator {

class TextDevice : public Device, public TextSpeaker {
 public:
  using Device::Device;

  TextSpeaker* speaker() final { return this; }
  const TextSpeaker* speaker() const final { return this; }

  pty::LineSettings line_settings() const override {
    pty::LineSettings line = model().text->settings;
    line.baud = settings().baud;
    return line;
  }
};

/// The map of all models without registers.
const RegisterMap& no_registers();

}  // namespace understudy::emulator
