#include "emulator/device/text/text_device.h"

namespace understudy::emulator {

const RegisterMap& no_registers() {
  static const RegisterMap none({}, MapPolicy{});
  return none;
}

}  // namespace understudy::emulator
