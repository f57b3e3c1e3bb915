#include "emulator/models/super_40nc/panel/pressed_keys.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "emulator/models/super_40nc/panel/keys.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"

namespace understudy::emulator::models::super_40nc {

namespace {

bool has_digit(std::int32_t mask, int digits, int digit) {
  std::int64_t rest = mask < 0 ? 0 : mask;
  for (int i = digits; i > digit; --i) rest /= 10;
  return rest % 10 != 0;
}

/// Returns contact M8x03 or M8x04.
int jog_contact(int axis, int direction) {
  return of_axis(direction > 0 ? m8x::kJogPlus : m8x::kJogMinus, axis);
}

}  // namespace

/// The wheel key on an axis's page has no contact; it selects the axis through D8020.
bool PressedKeys::is_wheel_locked(int axis) const {
  constexpr int kWheelDigit = 1;
  return chose(option("lock_scope", "keys_and_d8020")) &&
         has_digit(registers().raw(stored_x(d9x::kKeyLock), axis), kAxisLockDigits, kWheelDigit);
}

bool PressedKeys::is_locked(const Key& key) const {
  if (chose(option("lock_scope", "nothing"))) return false;
  const Settings settings = registers();
  return key.axis < 0 ? has_digit(settings.raw(stored_d(d9::kKeyLock)), kMainLockDigits, key.lock)
                      : has_digit(settings.raw(stored_x(d9x::kKeyLock), key.axis), kAxisLockDigits, key.lock);
}

/// A jog key writes its contact in each scan while it is pressed, and clears it when it is released. The lock
/// and X52 are read when the key is pressed. Even if they change afterwards, the axis stops with the key.
void PressedKeys::read_jog_keys() {
  const bool knows_older = !chose(option("jog_aliases", "plain_contacts"));
  for (int number = 0; number < kAxisCount; ++number) {
    const int sense = registers().is_on(stored_x(d9x::kJogDirection), number) ? -1 : +1;
    auto& driven = axis(number).jog_keys;
    for (std::size_t i = 0; i < driven.size(); ++i) {
      const int direction = i == 0 ? +1 : -1;
      bool is_down = false;
      bool is_pressed = false;
      for (const Key& key : kKeys) {
        const bool is_unknown = key.contact < kFirstJogKey && !knows_older;
        if (key.does != KeyDoes::jog || key.axis != number || key.direction != direction || is_unknown)
          continue;
        is_down = is_down || is_on(key.contact);
        is_pressed = is_pressed || (rises(key.contact) && !is_locked(key));
      }
      if (!is_down && driven[i] != 0) ground_.set_contact(jog_contact(number, driven[i]), false);
      if (!is_down) driven[i] = 0;
      if (is_pressed && driven[i] == 0) driven[i] = static_cast<std::int8_t>(direction * sense);
    }
    for (const std::int8_t direction : driven) {
      if (direction == 0) continue;
      ground_.set_contact(jog_contact(number, direction), true);
      ground_.state().contacts.write(jog_contact(number, direction), true);
    }
  }
}

void PressedKeys::read_keys() {
  read_jog_keys();
  const std::int32_t enabled = chose(option("zero_set_enable", "0_enables")) ? 0 : 1;
  const auto press = [&](int contact) {
    ground_.set_contact(contact, true);
    ground_.state().contacts.press(contact);
  };
  for (const Key& key : kKeys) {
    if (key.does == KeyDoes::jog || !rises(key.contact) || is_locked(key)) continue;
    switch (key.does) {
      case KeyDoes::jog: break;
      case KeyDoes::home: press(of_axis(m8x::kHome, key.axis)); break;
      case KeyDoes::zero: press(of_axis(m8x::kZero, key.axis)); break;
      case KeyDoes::oset: press(of_axis(m8x::kZeroSet, key.axis)); break;
      case KeyDoes::start: press(of_axis(m8x::kStart, key.axis)); break;
      case KeyDoes::start_c: press(m8::kStartOfC); break;
      case KeyDoes::pause_c: press(m8::kPause); break;
      case KeyDoes::set_zero:
        if (key.contact == kOriginKey && is_origin_the_home_key()) break;
        for (int number = 0; number < kAxisCount; ++number) {
          if (registers().raw(stored_x(d9x::kZeroSetEnable), number) == enabled)
            press(of_axis(m8x::kZeroSet, number));
        }
        break;
      // These keys have no contact: the parts that react to them call is_pressed().
      case KeyDoes::stop:
      case KeyDoes::stop_c:
      case KeyDoes::pause:
      case KeyDoes::home_by_order:
      case KeyDoes::zero_by_order: break;
    }
  }
}

bool PressedKeys::is_pressed(KeyDoes what, int axis) const {
  return std::any_of(kKeys.begin(), kKeys.end(), [&](const Key& key) {
    return key.does == what && key.axis == axis && rises(key.contact) && !is_locked(key);
  });
}

bool PressedKeys::is_stopped_by_emergency() const {
  return is_on(m8::kEmergencyStop) ||
         (ground_.state().emergency && !chose(option("cemg_input", "only_shown")));
}

bool PressedKeys::is_held_in_reset(int axis) const {
  return is_stopped_by_emergency() || is_on(of_axis(m8x::kReset, axis)) || is_pressed(KeyDoes::stop, axis);
}

bool PressedKeys::is_inhibited(int axis) const { return is_held_in_reset(axis) || is_on(m8::kMotionInhibit); }

bool PressedKeys::acts_behind_reset(int axis) const {
  return state_.were_held[static_cast<std::size_t>(axis)] && chose(option("level_after_stop", "act_at_once"));
}

bool PressedKeys::is_level_again(int axis, int contact) const {
  return is_on(contact) && acts_behind_reset(axis);
}

void PressedKeys::see_held() {
  for (int number = 0; number < kAxisCount; ++number) {
    state_.were_held[static_cast<std::size_t>(number)] = is_held_in_reset(number);
  }
}

}  // namespace understudy::emulator::models::super_40nc
