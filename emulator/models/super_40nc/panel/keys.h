// The panel's keys (《M85x 人機對應接點》), each with its contact, its function, and the digit that locks it.
#pragma once

#include <array>
#include <cstdint>

namespace understudy::emulator::models::super_40nc {

enum class KeyDoes : std::uint8_t {
  home_by_order,  // X50
  zero_by_order,  // X51
  set_zero,       // if X60 allows it
  pause_c,
  start_c,
  stop_c,
  jog,  // while pressed; X52 swaps the directions
  home,
  zero,
  oset,
  start,
  stop,
  pause,
};

struct Key {
  int contact = 0;
  KeyDoes does = KeyDoes::jog;
  int axis = -1;      // -1: on the main page, locked by D9025; otherwise on the axis's page, locked by D9x98
  int direction = 0;  // jog direction
  int lock = 0;       // the lock digit, counted from the left, beginning with 1
};

// Keys to which the code refers by name.
inline constexpr int kFirstJogKey = 8560;  // the older jog keys have lower numbers
inline constexpr int kOriginKey = 8514;    // the older name of the set-zero key

inline constexpr int kMainLockDigits = 6;
inline constexpr int kAxisLockDigits = 9;

/// All keys that have a function. Keys that are only storage, such as those for turning pages, are omitted.
inline constexpr auto kKeys = [] {
  constexpr int kMain = 6 + 5;
  constexpr int kJogAliases = 6;
  constexpr int kOfAxes = 4 * 8;
  std::array<Key, kMain + kJogAliases + kOfAxes> keys;
  std::size_t next = 0;
  const auto add = [&](const Key& key) { keys[next++] = key; };
  // Five keys have an older name with the same function (《命令範例》 also has the older names of the jog
  // keys).
  for (const auto& [contact, older, does, lock] :
       {std::array{8592, 0, static_cast<int>(KeyDoes::home_by_order), 1},
        std::array{8593, 8513, static_cast<int>(KeyDoes::zero_by_order), 2},
        std::array{8594, kOriginKey, static_cast<int>(KeyDoes::set_zero), 3},
        std::array{8597, 8510, static_cast<int>(KeyDoes::pause_c), 4},
        std::array{8595, 8508, static_cast<int>(KeyDoes::start_c), 5},
        std::array{8596, 8509, static_cast<int>(KeyDoes::stop_c), 6}}) {
    const Key key{.contact = contact, .does = static_cast<KeyDoes>(does), .lock = lock};
    add(key);
    if (older == 0) continue;
    add({.contact = older, .does = key.does, .lock = lock});
  }
  for (int axis = 0; axis < 4; ++axis) {
    add({.contact = kFirstJogKey + 2 * axis, .does = KeyDoes::jog, .axis = axis, .direction = +1, .lock = 2});
    add({.contact = kFirstJogKey + 1 + 2 * axis,
         .does = KeyDoes::jog,
         .axis = axis,
         .direction = -1,
         .lock = 3});
    add({.contact = 8568 + axis, .does = KeyDoes::home, .axis = axis, .lock = 4});
    add({.contact = 8572 + axis, .does = KeyDoes::zero, .axis = axis, .lock = 5});
    add({.contact = 8576 + axis, .does = KeyDoes::oset, .axis = axis, .lock = 6});
    add({.contact = 8588 + axis, .does = KeyDoes::pause, .axis = axis, .lock = 7});
    add({.contact = 8580 + axis, .does = KeyDoes::start, .axis = axis, .lock = 8});
    add({.contact = 8584 + axis, .does = KeyDoes::stop, .axis = axis, .lock = 9});
    if (axis == 3) continue;  // U has no older jog keys
    add({.contact = 8519 + 2 * axis, .does = KeyDoes::jog, .axis = axis, .direction = +1, .lock = 2});
    add({.contact = 8520 + 2 * axis, .does = KeyDoes::jog, .axis = axis, .direction = -1, .lock = 3});
  }
  return keys;
}();

}  // namespace understudy::emulator::models::super_40nc
