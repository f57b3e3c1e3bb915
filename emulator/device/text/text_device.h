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

  // Nothing is there that registers could be asked of.
  std::span<std::uint32_t> image() final { return {}; }
  std::span<const std::uint32_t> image() const final { return {}; }
  void register_written(const RegisterRow&, std::size_t) final {}
  Addressing addressing(std::uint8_t) const final { return Addressing::ignore; }
  std::span<const std::uint32_t> kept_image() const final { return {}; }

  pty::LineSettings line_settings() const override {
    pty::LineSettings line = model().text->settings;
    line.baud = settings().baud;
    return line;
  }

 protected:
  void put_kept(std::size_t, std::uint32_t) final {}
};

/// The map of all models without registers.
const RegisterMap& no_registers();

}  // namespace understudy::emulator
