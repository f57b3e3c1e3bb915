// The special contacts that were written since the last scan. A contact that a host switches ON and OFF
// between two scans is ON for one of them. An edge counts even if the contact is written again afterwards.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/models/super_40nc/rows/names.h"

namespace understudy::emulator::models::super_40nc {

struct Contacts {
  static constexpr int kFirst = m8::kStartOfC;
  static constexpr std::size_t kCount = 700;

  std::array<std::uint8_t, kCount> flags{};

  bool operator==(const Contacts&) const = default;

  /// Records a write by a host or by a panel key.
  void write(int contact, bool on) {
    std::uint8_t& flag = flags[place(contact)];
    if (on) flag |= (flag & kLevel) == 0 ? kLevel | kWasOn | kRose : kWasOn;
    if (!on) flag = static_cast<std::uint8_t>(flag & ~kLevel);
  }
  /// Records a press of a command key, which is an edge even if the contact is already ON.
  void press(int contact) { flags[place(contact)] |= kLevel | kWasOn | kRose; }
  /// Records a write by a program. In this case, the contact step of the scan considers only the level.
  void overwrite(int contact) {
    std::uint8_t& flag = flags[place(contact)];
    flag = static_cast<std::uint8_t>(flag & ~kWasOn);
  }
  /// Returns true if the contact is ON for this scan. `level` is its stored value.
  bool on(int contact, bool level) const { return level || (flags[place(contact)] & kWasOn) != 0; }
  bool rose(int contact, bool level) const {
    const std::uint8_t flag = flags[place(contact)];
    return (flag & kRose) != 0 || (level && (flag & kSeen) == 0);
  }
  /// Ends a scan: records the level that the scan has seen.
  void see(int contact, bool level) { flags[place(contact)] = level ? kLevel | kSeen : std::uint8_t{0}; }

 private:
  static constexpr std::uint8_t kLevel = 1;  // the last written level
  static constexpr std::uint8_t kRose = 2;   // since the last scan
  static constexpr std::uint8_t kWasOn = 4;  // has been ON since the last scan
  static constexpr std::uint8_t kSeen = 8;   // was ON in the last scan
  static std::size_t place(int contact) { return static_cast<std::size_t>(contact - kFirst); }
};

}  // namespace understudy::emulator::models::super_40nc
