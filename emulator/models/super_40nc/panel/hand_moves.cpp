#include "emulator/models/super_40nc/panel/hand_moves.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/marks.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/panel/keys.h"
#include "emulator/models/super_40nc/path/manual_motions.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"

namespace understudy::emulator::models::super_40nc {

namespace {

constexpr int kOrders = 4;
constexpr int kWheelContacts[] = {m8x::kMpg1, m8x::kMpg10, m8x::kMpg100};
constexpr WheelSource kWheelSources[] = {WheelSource::contact_1, WheelSource::contact_10,
                                         WheelSource::contact_100};

}  // namespace

/// Starts the axes with the same order number together, and those of the next number when all of them have
/// finished.
void HandMoves::follow_order(OrderKey& key, Activity holder, StoredRegister order_of_axis,
                             void (Homes::*start)(int, int)) {
  const auto is_under_way = [&](const AxisState& state) {
    return state.holder == holder && state.order != 0;
  };
  while (key.runs && std::none_of(axes_.axes.begin(), axes_.axes.end(), is_under_way)) {
    const bool is_given_up = key.has_failed && !chose(option("order_after_failure", "next_number_starts"));
    if (is_given_up || key.order == kOrders) {
      key = {};
      return;
    }
    ++key.order;
    for (int number = 0; number < kAxisCount; ++number) {
      if (registers().raw(order_of_axis, number) == key.order && !keys_.is_inhibited(number)) {
        (parts_.homes.*start)(number, key.order);
      }
    }
  }
}

void HandMoves::give_up_orders() {
  axes_.homing_by_key = axes_.zeroing_by_key = {};
  for (AxisState& state : axes_.axes) take_off(state, MarkEvent::orders_given_up);
}

void HandMoves::apply_order_keys() {
  const auto press = [&](OrderKey& key, KeyDoes what) {
    if (!key.runs && keys_.is_pressed(what, -1)) key = {.runs = true};
  };
  press(axes_.homing_by_key, KeyDoes::home_by_order);
  // As a HOME key, M8514 is subject to the lock digit of HOME.
  constexpr int kHomeDigit = 1;
  const bool is_home_key = keys_.is_origin_the_home_key() && rises(kOriginKey);
  const Key as_home{.contact = kOriginKey, .does = KeyDoes::home_by_order, .lock = kHomeDigit};
  if (is_home_key && !axes_.homing_by_key.runs && !keys_.is_locked(as_home))
    axes_.homing_by_key = {.runs = true};
  press(axes_.zeroing_by_key, KeyDoes::zero_by_order);
  follow_order(axes_.homing_by_key, Activity::home, stored_x(d9x::kHomeSequence), &Homes::start_home);
  follow_order(axes_.zeroing_by_key, Activity::zero, stored_x(d9x::kZeroSequence), &Homes::start_zero);
}

void HandMoves::apply_jogs(int axis) {
  for (const int direction : {+1, -1}) {
    const int contact = of_axis(direction > 0 ? m8x::kJogPlus : m8x::kJogMinus, axis);
    const bool asks = rises(contact) || keys_.is_level_again(axis, contact);
    if (asks && !keys_.is_inhibited(axis))
      parts_.jogs.start_jog(axis, direction, &AxisState::asked_by_contact);
  }
  const int contact = of_axis(chip(axis).last_direction > 0 ? m8x::kJogPlus : m8x::kJogMinus, axis);
  if (!is_on(contact)) moves_.handle(axis, ManualMotion::jog, ManualEvent::contact_off);
}

void HandMoves::apply_wheel() {
  for (int number = 0; number < kAxisCount; ++number) {
    for (std::size_t i = 0; i < std::size(kWheelContacts); ++i) {
      const int contact = of_axis(kWheelContacts[i], number);
      const bool asks = rises(contact) || keys_.is_level_again(number, contact);
      if (asks && !keys_.is_inhibited(number)) parts_.wheel.start_wheel(number, kWheelSources[i]);
      if (axis(number).wheel == kWheelSources[i] && !is_on(contact))
        moves_.handle(number, ManualEvent::contact_off);
    }
  }
  if (!state_.wheel_selected) return;
  state_.wheel_selected = false;
  const std::int32_t selected = registers().raw(stored_d(d8::kUserCommand)) - 1;
  for (int number = 0; number < kAxisCount; ++number) {
    const bool is_left = number != selected && axis(number).wheel == WheelSource::selector;
    if (is_left) moves_.handle(number, ManualEvent::contact_off);
  }
  if (selected >= 0 && selected < kAxisCount && !keys_.is_inhibited(selected) &&
      !keys_.is_wheel_locked(selected)) {
    parts_.wheel.start_wheel(selected, WheelSource::selector);
  }
}

void HandMoves::slow_by_hand(int axis_number) {
  if (moves_.manual_motion(axis_number)) moves_.end_by_ramp(axis_number, Mover::hand);
}

void HandMoves::apply_contacts() {
  for (int number = 0; number < kAxisCount; ++number) {
    if (rises(of_axis(m8x::kHome, number)) && !keys_.is_inhibited(number)) parts_.homes.start_home(number);
  }
  for (int number = 0; number < kAxisCount; ++number) {
    if (rises(of_axis(m8x::kZero, number)) && !keys_.is_inhibited(number)) parts_.homes.start_zero(number);
  }
  apply_order_keys();
  for (int number = 0; number < kAxisCount; ++number) apply_jogs(number);
  apply_wheel();
}

}  // namespace understudy::emulator::models::super_40nc
