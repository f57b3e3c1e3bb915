// What was written to the special contacts since the last scan. One that a host switches ON and OFF between
// two scans is ON for one of them, and an edge counts whatever a later writer makes of the contact.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace understudy::emulator::models::super_40nc {

struct Contacts {
  static constexpr int kFirst = 8000;
  static constexpr std::size_t kCount = 700;

  std::array<std::uint8_t, kCount> flags{};

  bool operator==(const Contacts&) const = default;

  /// From outside, or by a key of the panel.
  void write(int contact, bool on) {
    std::uint8_t& its = flags[place(contact)];
    if (on) its |= (its & kLevel) == 0 ? kLevel | kWasOn | kRose : kWasOn;
    if (!on) its = static_cast<std::uint8_t>(its & ~kLevel);
  }
  /// By a key that gives a command: an edge even where the contact is ON from before.
  void press(int contact) { flags[place(contact)] |= kLevel | kWasOn | kRose; }
  /// By a program: its level counts where the scan comes to the contacts.
  void overwrite(int contact) {
    std::uint8_t& its = flags[place(contact)];
    its = static_cast<std::uint8_t>(its & ~kWasOn);
  }
  /// `level`: as it is stored.
  bool on(int contact, bool level) const { return level || (flags[place(contact)] & kWasOn) != 0; }
  bool rose(int contact, bool level) const {
    const std::uint8_t its = flags[place(contact)];
    return (its & kRose) != 0 || (level && (its & kSeen) == 0);
  }
  bool was_seen_on(int contact) const { return (flags[place(contact)] & kSeen) != 0; }
  /// At the end of a scan.
  void see(int contact, bool level) { flags[place(contact)] = level ? kLevel | kSeen : std::uint8_t{0}; }

 private:
  static constexpr std::uint8_t kLevel = 1;  // as it was last written
  static constexpr std::uint8_t kRose = 2;   // since the last scan
  static constexpr std::uint8_t kWasOn = 4;  // likewise
  static constexpr std::uint8_t kSeen = 8;   // ON in the last scan
  static std::size_t place(int contact) { return static_cast<std::size_t>(contact - kFirst); }
};

}  // namespace understudy::emulator::models::super_40nc
