// The Modbus side of a device apart from its registers: the addresses it responds to, whether it answers
// refusals, and notification of receive errors. This is a facet: Device::modbus() is null if a device uses
// another protocol.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/device/model.h"
#include "pty/receive_error.h"  // IWYU pragma: export: devices are notified of them

namespace understudy::emulator {

inline constexpr Protocol kModbusRtu{"Modbus"};

/// A station's reaction to the address of a frame.
enum class Addressing : std::uint8_t { ignore, execute_silently, execute_and_reply };

class ModbusStation {
 public:
  virtual Addressing addressing(std::uint8_t address) const = 0;
  /// Returns true if the device supports this function code of its model.
  virtual bool knows(std::uint8_t /*function*/) const { return true; }
  /// Returns the silence that ends a frame. `usual` is the model's own value.
  virtual pty::SimTime end_silence(pty::SimTime usual) const { return usual; }
  /// Returns the delay of a reply after that silence.
  virtual pty::SimTime reply_delay() const { return pty::SimTime{0}; }
  /// Returns true if the device answers refused requests with an exception; otherwise it does not answer
  /// them.
  virtual bool answers_refusals() const { return true; }
  /// Called when characters at that port were not a frame, while the device has power. They get no answer.
  virtual void receive_failed(std::size_t /*port*/, pty::ReceiveError /*error*/) {}

 protected:
  ~ModbusStation() = default;
};

}  // namespace understudy::emulator
