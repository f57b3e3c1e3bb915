// What a device that speaks Modbus offers beside its registers: which addresses it listens to, and
// whether it refuses, and that it counts what was wrong. A facet: Device::modbus() is null where a device
// speaks something else.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/device/model.h"
#include "pty/receive_error.h"  // IWYU pragma: export: devices are told of them

namespace understudy::emulator {

/// Frames of Modbus RTU.
inline constexpr Protocol kModbusRtu{"Modbus"};

/// What a station does with a frame that carries some address.
enum class Addressing : std::uint8_t { ignore, obey_silently, obey_and_reply };

class ModbusStation {
 public:
  virtual Addressing addressing(std::uint8_t address) const = 0;
  /// Of those of its model.
  virtual bool knows(std::uint8_t /*function*/) const { return true; }
  /// The silence that ends a frame for it; the model's is the usual one.
  virtual pty::SimTime end_silence(pty::SimTime usual) const { return usual; }
  /// How long after that silence it replies.
  virtual pty::SimTime reply_delay() const { return pty::SimTime{0}; }
  /// Whether a request that it refuses gets an exception, or no answer.
  virtual bool answers_refusals() const { return true; }
  /// What came in by that port was not a frame; it gets no answer. Only while the device has power.
  virtual void receive_failed(std::size_t /*port*/, pty::ReceiveError /*error*/) {}

 protected:
  ~ModbusStation() = default;
};

}  // namespace understudy::emulator
