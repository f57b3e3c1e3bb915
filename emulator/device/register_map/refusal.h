// Reasons why a request for registers was not executed: general reasons for the protocol's answer, and
// detailed reasons that a device can record.
#pragma once

#include <cstddef>
#include <cstdint>

namespace understudy::emulator {

/// The general reason, which each protocol translates (Modbus: an exception code).
enum class Refusal : std::uint8_t {
  none,
  no_register,  // no register at that address, or half a register if that is not allowed, or a write to a
                // read-only register
  bad_value,    // outside the register's range, or a message that the device does not accept
  busy,         // the device cannot process it now
  failure,      // the device failed to execute it
};

enum class Cause : std::uint8_t {
  none,
  unknown_function,
  bad_count,    // zero, or more than a request may have
  bad_length,   // the byte count or the frame's length does not match the count
  no_register,  // no register at the address, or beyond the table
  read_only,
  write_only,
  cut_pair,     // half of a 32-bit register
  cut_message,  // a write to a window that does not begin at its first word, or extends beyond its end
  out_of_range,
  bad_bit,      // a single bit written as neither 0x0000 nor 0xFF00
  bad_message,  // the window's reader refused the message
  busy,
  failure,
};

/// The device's own answer to a request, with its number for the reason, if any.
struct DeviceAnswer {
  constexpr DeviceAnswer(Refusal given, int number = 0)  // NOLINT(google-explicit-constructor): `return busy`
      : refusal(given), reason(static_cast<std::uint16_t>(number)) {}

  Refusal refusal = Refusal::none;
  std::uint16_t reason = 0;  // the device's number for the reason; 0: it has none
};

/// A refusal with its cause and the address where it was found.
struct Objection {
  Refusal refusal = Refusal::none;
  Cause cause = Cause::none;
  std::uint16_t address = 0;
  std::uint16_t reason = 0;  // the device's number (DeviceAnswer), if the device refused

  explicit operator bool() const { return refusal != Refusal::none; }
  bool operator==(const Objection&) const = default;
};

/// A request that was answered with an exception, as reported to the device.
struct RefusedRequest {
  std::uint8_t function = 0;
  std::uint16_t first = 0;  // 0 if the request has no address, or is too short
  std::size_t count = 0;    // 0 in the same cases
  int exception = 0;        // the exception code in the answer
  Objection objection{};    // the reason
};

}  // namespace understudy::emulator
