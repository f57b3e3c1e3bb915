#include "emulator/world/speech/line_speech.h"

#include <array>
#include <stdexcept>
#include <string>
#include "emulator/device/model.h"

namespace understudy::emulator::world {

const LineSpeech& speech_of(const Model& model) {
  for (const LineSpeech* const speech : std::array{&modbus_speech(), &text_speech()}) {
    if (&speech->protocol() == &model.line.protocol) return *speech;
  }
  throw std::logic_error(std::string(model.name) + ": no line of a world carries " +
                         std::string(model.line.protocol.name));
}

}  // namespace understudy::emulator::world
