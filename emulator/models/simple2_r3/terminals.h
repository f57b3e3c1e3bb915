// Simple2-R3's terminals, in the order of the table in model.cpp.
#pragma once

namespace understudy::emulator::models::simple2_r3 {

inline constexpr int kInputCount = 11;
inline constexpr int kOutputCount = 7;
inline constexpr int kAnalogCount = 2;
inline constexpr int kSwitchCount = 2;
// The first terminal of each kind.
inline constexpr int kFirstOutput = kInputCount;
inline constexpr int kFirstAnalog = kFirstOutput + kOutputCount;
inline constexpr int kFirstSwitch = kFirstAnalog + kAnalogCount;
inline constexpr int kTerminalCount = kFirstSwitch + kSwitchCount;

}  // namespace understudy::emulator::models::simple2_r3
