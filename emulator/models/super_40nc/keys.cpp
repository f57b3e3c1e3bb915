// How a scan handles the panel's keys: they switch command contacts; HOME and ZERO of the main page begin
// with the axes of the first order.
#include "emulator/models/super_40nc/keys.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/marks.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/ownership.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "emulator/models/super_40nc/settings.h"

namespace understudy::emulator::models::super_40nc {

namespace {

constexpr int kOrders = 4;

bool has_digit(std::int32_t mask, int digits, int digit) {
  std::int64_t rest = mask < 0 ? 0 : mask;
  for (int i = digits; i > digit; --i) rest /= 10;
  return rest % 10 != 0;
}

/// Returns contact M8x03 or M8x04.
int jog_contact(int axis, int direction) {
  return of_axis(direction > 0 ? m8x::kJogPlus : m8x::kJogMinus, axis);
}

/// Returns which of its two meanings M8514 has.
bool is_origin_the_home_key(const Super40nc& device) { return device.chose(option("m8514_meaning", "home")); }

}  // namespace

/// The wheel key of an axis's page has no contact; it selects by D8020.
bool Super40nc::is_wheel_locked(int axis) const {
  constexpr int kWheelDigit = 1;
  return chose(option("lock_scope", "keys_and_d8020")) &&
         has_digit(registers().raw(kept_x(d9x::kKeyLock), axis), kAxisLockDigits, kWheelDigit);
}

bool Super40nc::is_locked(const Key& key) const {
  if (chose(option("lock_scope", "nothing"))) return false;
  const Settings settings = registers();
  return key.axis < 0 ? has_digit(settings.raw(kept_d(d9::kKeyLock)), kMainLockDigits, key.lock)
                      : has_digit(settings.raw(kept_x(d9x::kKeyLock), key.axis), kAxisLockDigits, key.lock);
}

/// A jog key writes its contact in each scan while it is pressed, and clears it when it is released. Its lock
/// and X52 count when it is pressed: even if they change meanwhile, the axis stops with the key.
void Super40nc::read_jog_keys() {
  const bool knows_older = !chose(option("jog_aliases", "plain_contacts"));
  for (int number = 0; number < kAxisCount; ++number) {
    const int sense = registers().is_on(kept_x(d9x::kJogDirection), number) ? -1 : +1;
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
      if (!is_down && driven[i] != 0) set_contact(jog_contact(number, driven[i]), false);
      if (!is_down) driven[i] = 0;
      if (is_pressed && driven[i] == 0) driven[i] = static_cast<std::int8_t>(direction * sense);
    }
    for (const std::int8_t direction : driven) {
      if (direction == 0) continue;
      set_contact(jog_contact(number, direction), true);
      state_.contacts.write(jog_contact(number, direction), true);
    }
  }
}

void Super40nc::read_keys() {
  read_jog_keys();
  const std::int32_t enabled = chose(option("zero_set_enable", "0_enables")) ? 0 : 1;
  const auto press = [&](int contact) {
    set_contact(contact, true);
    state_.contacts.press(contact);
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
        if (key.contact == kOriginKey && is_origin_the_home_key(*this)) break;
        for (int number = 0; number < kAxisCount; ++number) {
          if (registers().raw(kept_x(d9x::kZeroSetEnable), number) == enabled)
            press(of_axis(m8x::kZeroSet, number));
        }
        break;
      // These have no contact of their own: obey_contacts() checks them.
      case KeyDoes::stop:
      case KeyDoes::stop_c:
      case KeyDoes::pause:
      case KeyDoes::home_by_order:
      case KeyDoes::zero_by_order: break;
    }
  }
}

bool Super40nc::is_pressed(KeyDoes what, int axis) const {
  return std::any_of(kKeys.begin(), kKeys.end(), [&](const Key& key) {
    return key.does == what && key.axis == axis && rises(key.contact) && !is_locked(key);
  });
}

/// Starts the axes of one order together, and the next order when all of them have finished.
void Super40nc::follow_order(OrderKey& key, Activity holder, Kept order_of_axis,
                             void (Super40nc::*start)(int, int)) {
  const auto is_under_way = [&](const AxisState& state) {
    return state.holder == holder && state.order != 0;
  };
  while (key.runs && std::none_of(state_.axes.begin(), state_.axes.end(), is_under_way)) {
    const bool is_given_up = key.has_failed && !chose(option("order_after_failure", "next_number_starts"));
    if (is_given_up || key.order == kOrders) {
      key = {};
      return;
    }
    ++key.order;
    for (int number = 0; number < kAxisCount; ++number) {
      if (registers().raw(order_of_axis, number) == key.order && !is_inhibited(number)) {
        (this->*start)(number, key.order);
      }
    }
  }
}

/// Drops the orders: axes that are still stopping do not belong to a key pressed meanwhile.
void Super40nc::give_up_orders() {
  state_.homing_by_key = state_.zeroing_by_key = {};
  for (AxisState& state : state_.axes) take_off(state, MarkEvent::orders_given_up);
}

void Super40nc::obey_order_keys() {
  const auto press = [&](OrderKey& key, KeyDoes what) {
    if (!key.runs && is_pressed(what, -1)) key = {.runs = true};
  };
  press(state_.homing_by_key, KeyDoes::home_by_order);
  // As a HOME key it obeys the lock digit of HOME.
  constexpr int kHomeDigit = 1;
  const bool is_home_key = is_origin_the_home_key(*this) && rises(kOriginKey);
  const Key as_home{.contact = kOriginKey, .does = KeyDoes::home_by_order, .lock = kHomeDigit};
  if (is_home_key && !state_.homing_by_key.runs && !is_locked(as_home)) state_.homing_by_key = {.runs = true};
  press(state_.zeroing_by_key, KeyDoes::zero_by_order);
  follow_order(state_.homing_by_key, Activity::home, kept_x(d9x::kHomeSequence), &Super40nc::start_home);
  follow_order(state_.zeroing_by_key, Activity::zero, kept_x(d9x::kZeroSequence), &Super40nc::start_zero);
}

}  // namespace understudy::emulator::models::super_40nc
