// The Modbus side of a device, except its registers: the addresses to which it responds, whether it answers
// refusals, and the notification of receive errors. This is a facet: Device::modbus() is null if a device
// uses another protocol.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "emulator/device/model.h"
#include "pty/receive_error.h"  // IWYU pragma: export: receive_failed() uses it

namespace understudy::emulator {

inline constexpr Protocol kModbusRtu{"Modbus"};

/// How a station reacts to the address in a frame.
enum class Addressing : std::uint8_t { ignore, execute_silently, execute_and_reply };

class Reasons;

class ModbusStation {
 public:
  virtual Addressing addressing(std::uint8_t address) const = 0;
  /// Returns true if the device supports this function code, which is one of its model's.
  virtual bool knows(std::uint8_t /*function*/) const { return true; }
  /// Returns the silence that ends a frame. `usual` is the model's own value.
  virtual pty::SimTime end_silence(pty::SimTime usual) const { return usual; }
  /// Returns the delay between that silence and a reply.
  virtual pty::SimTime reply_delay() const { return pty::SimTime{0}; }
  /// Returns true if the device answers refused requests with an exception. Otherwise, it does not answer
  /// them.
  virtual bool answers_refusals() const { return true; }
  /// Returns where the device says why commands had no effect, or null if it does not.
  virtual Reasons* reasons() { return nullptr; }
  /// Returns what the device's own number for the reason of a refusal means, or an empty text.
  virtual std::string_view meaning_of_reason(int /*reason*/) const { return {}; }
  /// Called when characters at that port were not a frame, while the device has power. They get no answer.
  virtual void receive_failed(std::size_t /*port*/, pty::ReceiveError /*error*/) {}

 protected:
  ~ModbusStation() = default;
};

}  // namespace understudy::emulator
