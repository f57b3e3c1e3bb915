// The registers that the hosts use, and operations on them: those of a Simple2-R3, and one of an RS-M8194H.
#pragma once

#include <cstdint>

#include "tests/planted_hosts/line.h"

namespace understudy::planted {

inline constexpr int kStatus = 0x0000;
inline constexpr int kAlarm = 1 << 0;
inline constexpr int kMoving = 1 << 4;
inline constexpr int kIsHome = 1 << 8;
inline constexpr int kStopInput = 0x0D1A;  // DIN_10
inline constexpr int kEncoder = 0x0E00;
inline constexpr int kPosition = 0x0E04;
inline constexpr int kPulses = 0x1000;
inline constexpr int kSpeed = 0x1002;
inline constexpr int kMove = 0x1005;
inline constexpr int kStop = 0x100E;
inline constexpr int kGoHome = 0x1011;
inline constexpr int kServo = 0x1014;
inline constexpr int kClearAlarm = 0x1017;
inline constexpr int kMoveTo = 0x101C;
inline constexpr int kPartsMade = 0x005A;  // of an RS-M8194H

inline Words words_of(std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  return {static_cast<std::uint16_t>(bits), static_cast<std::uint16_t>(bits >> 16)};
}

inline std::int32_t value_of(const Words& words) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(words[0]) | static_cast<std::uint32_t>(words[1])
                                                                              << 16);
}

inline void set_up(Line& line) {
  line.surely_write(kServo, 1);
  line.surely_write(kSpeed, 200);
}

inline bool is_moving(Line& line) { return (line.surely_read(kStatus) & kMoving) != 0; }
inline std::int32_t position(Line& line) { return value_of(line.surely_read(kPosition, 2)); }

inline void wait_for_end(Line& line) {
  while (is_moving(line)) sleep_ms(20);
}

}  // namespace understudy::planted
