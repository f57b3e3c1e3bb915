// What a device offers that is spoken to in Modbus, beside its registers: which addresses it listens to, and
// whether it refuses. A facet: Device::modbus() is null where a device speaks something else.
#pragma once

#include <cstdint>

#include "emulator/device/model.h"

namespace understudy::emulator {

/// Frames of Modbus RTU.
inline constexpr Protocol kModbusRtu{"Modbus"};

/// What a station does with a frame that carries some address.
enum class Addressing : std::uint8_t { ignore, obey_silently, obey_and_reply };

class ModbusStation {
 public:
  virtual Addressing addressing(std::uint8_t address) const = 0;
  /// Whether a request that it refuses gets an exception, or no answer.
  virtual bool answers_refusals() const { return true; }

 protected:
  ~ModbusStation() = default;
};

}  // namespace understudy::emulator
