#include "emulator/models/super_40nc/program_machine.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/manual_motions.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/ownership.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "emulator/models/super_40nc/settings.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/requests.h"

namespace understudy::emulator::models::super_40nc {

using language::Area;
using language::Begun;

namespace {

constexpr std::uint32_t cell_of_slot(Kept kept) { return static_cast<std::uint32_t>(kept.slot); }

Mover mover_of(Area area) { return static_cast<Mover>(area); }

}  // namespace

// ---- contacts and registers

language::CellLayout ProgramMachine::layout() const {
  return {.x = cell_of_slot(kFirstX),
          .y = cell_of_slot(kFirstY),
          .m = cell_of_slot(kFirstM),
          .t = cell_of_slot(kept_at(Table::coil, kFirstTimerContact)),
          .c = cell_of_slot(kept_at(Table::coil, kFirstCounterContact)),
          .t_value = cell_of_slot(kept_at(Table::holding, kFirstTimerValue)),
          .c_value = cell_of_slot(kept_at(Table::holding, kFirstCounterValue)),
          .d = cell_of_slot(kFirstD)};
}

void ProgramMachine::kept_cell_written(std::uint32_t cell) { device_.keep_slot(cell); }

bool ProgramMachine::special_contact(int number) const {
  if (const std::size_t slot = relay_slot(number); slot != kNotKept) return device_.state().image[slot] != 0;
  return read_value(device_, device_.at(Table::coil, relay_address(number))) != 0;
}

bool ProgramMachine::set_special_contact(int number, bool on) {
  const std::size_t slot = relay_slot(number);
  if (slot == kNotKept || special_contact(number) == on) return false;
  if (kIsUnlisted[slot] && !device_.keeps_unlisted()) return false;
  device_.set_contact(number, on);
  device_.state().contacts.overwrite(number);
  device_.keep_slot(slot);
  device_.state().touched = true;
  return true;
}

std::int32_t ProgramMachine::special_register(int number) const {
  Place place = device_.at(Table::holding, data_address(number));
  place.part = Place::Part::whole;  // both words on the wire
  return static_cast<std::int32_t>(read_value(device_, place));
}

bool ProgramMachine::set_special_register(int number, std::int32_t value) {
  const std::int32_t before = special_register(number);
  const auto bits = static_cast<std::uint32_t>(value);
  const std::array<std::uint16_t, 2> words{static_cast<std::uint16_t>(bits),
                                           static_cast<std::uint16_t>(bits >> 16)};
  write_words(device_, Table::holding, data_address(number), words);
  return special_register(number) != before;
}

std::int32_t ProgramMachine::parameter_in_force(int number) const {
  const std::vector<std::uint32_t>& in_force = device_.state().parameters_in_force;
  if (in_force.empty()) return special_register(number);
  const Place place = device_.at(Table::holding, data_address(number));
  return static_cast<std::int32_t>(in_force[static_cast<std::size_t>(place.slot) - kFirstParameterSlot]);
}

std::int32_t ProgramMachine::rpm_at_power_up(int axis) const {
  return device_.state().rpm_at_power_up[static_cast<std::size_t>(axis)];
}

void ProgramMachine::report(language::Code code, Area area, int step) {
  device_.report({.code = code, .step = step, .area = area});
}

// ---- step programs

bool ProgramMachine::is_held_in_reset(Area area) const {
  const int axis = language::axis_of(area);
  return axis < 0 ? device_.is_stopped_by_emergency() : device_.is_held_in_reset(axis);
}

void ProgramMachine::program_starts(Area) { device_.error_is_over(); }

void ProgramMachine::program_ended(Area area) {
  for (int axis = 0; axis < kAxisCount && device_.chose(option("end_and_vdrv", "ends_by_its_ramp")); ++axis) {
    const AxisState& state = device_.axis(axis);
    if (state.holder == Activity::vdrv && state.mover == mover_of(area))
      device_.end_by_ramp(axis, Mover::hand);
  }
  device_.show_finished(
      area == Area::c ? kEndOfCSignal : kFirstEndSignal + static_cast<std::size_t>(language::axis_of(area)));
}

template <class Start>
Begun ProgramMachine::begin_each(Area by, const language::AxisValues& values, Request request, Start start) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (is_set(values, axis) && device_.granted(device_.axis(axis).holder, request) == Grant::waits)
      return Begun::taken;
  }
  bool has_begun = false;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (!is_set(values, axis)) continue;
    if (device_.granted(device_.axis(axis).holder, request) != Grant::starts) {
      device_.report(Code::axis_taken, mover_of(by));
      continue;
    }
    if (!start(axis, value_of_axis(values, axis))) {
      device_.break_program(mover_of(by));
      return Begun::refused;
    }
    has_begun = true;
  }
  if (device_.is_awaited_by(mover_of(by))) return Begun::runs;
  return has_begun ? Begun::done : Begun::ignored;
}

Begun ProgramMachine::begin(Area by, const language::Drive& drive) {
  return begin_each(by, drive.target_lu, Request::line, [&](int axis, std::int32_t value) {
    const std::int64_t base =
        drive.targets == language::Targets::relative ? device_.relative_base_lu(axis) : 0;
    const std::int32_t rpm = drive.rpm[static_cast<std::size_t>(axis)];
    if (!device_.begin_drive(axis, base + value, rpm, mover_of(by))) return false;
    AxisState& state = device_.axis(axis);
    if (state.holder == Activity::move) state.awaited = drive.is_waited_for;
    return true;
  });
}

Begun ProgramMachine::begin(Area by, const language::MarkSearch& search) {
  return begin_each(by, search.target_lu, Request::line, [&](int axis, std::int32_t value) {
    const std::int64_t base =
        search.targets == language::Targets::relative ? device_.relative_base_lu(axis) : 0;
    const std::int32_t rpm = search.rpm[static_cast<std::size_t>(axis)];
    const std::int64_t beyond = device_.search_pulses(axis);
    const std::int64_t distance = device_.distance_to(axis, base + value);
    const bool is_against = (beyond < 0 && distance > 0) || (beyond > 0 && distance < 0);
    if (is_against && device_.chose(option("mrk_against", "void_with_a_code"))) {
      device_.report(Code::out_of_range, mover_of(by));
      return true;
    }
    const bool begins = beyond == 0 ? device_.begin_blind_mark(axis, base + value, rpm, mover_of(by))
                                    : device_.begin_mark(axis, distance, beyond, rpm, mover_of(by));
    if (begins && device_.axis(axis).holder == Activity::move) device_.axis(axis).awaited = true;
    return begins;
  });
}

Begun ProgramMachine::begin(Area by, const language::HomeSearch& search) {
  language::AxisValues values;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    if ((search.axes >> axis & 1U) != 0) values[axis] = 1;
  }
  return begin_each(by, values, Request::line, [&](int axis, std::int32_t) {
    AxisState& state = device_.axis(axis);
    state.mover = mover_of(by);
    device_.start_home(axis);
    if (state.holder != Activity::home) return false;
    state.awaited = true;
    return true;
  });
}

Begun ProgramMachine::begin(Area by, const language::Rotation& rotation) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const bool turns = is_set(rotation.rpm, axis) && value_of_axis(rotation.rpm, axis) != 0;
    const Activity holder = device_.axis(axis).holder;
    const bool is_others =
        holder != Activity::nobody && holder != Activity::vdrv && holder != Activity::wheel;
    if (is_set(rotation.rpm, axis) && !turns && is_others &&
        device_.chose(option("vdrv_zero_others", "waits"))) {
      return Begun::taken;
    }
    if (turns && device_.granted(device_.axis(axis).holder, Request::vdrv) == Grant::waits)
      return Begun::taken;
  }
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (!is_set(rotation.rpm, axis)) continue;
    const std::int32_t rpm = value_of_axis(rotation.rpm, axis);
    if (rpm == 0) {
      const bool is_at_once = device_.chose(option("vdrv_zero_stop", "at_once"));
      is_at_once ? device_.stop_axis(axis) : void(device_.end_by_ramp(axis, mover_of(by)));
      continue;
    }
    const Grant given = device_.granted(device_.axis(axis).holder, Request::vdrv);
    if (given == Grant::new_speed) {
      device_.change_turning(axis, rpm, mover_of(by));
    } else if (given != Grant::starts) {
      device_.report(Code::axis_taken, mover_of(by));
    } else if (!device_.begin_turning(axis, rpm, mover_of(by))) {
      device_.break_program(mover_of(by));
      return Begun::refused;
    }
  }
  return device_.is_awaited_by(mover_of(by)) ? Begun::runs : Begun::done;
}

Begun ProgramMachine::begin(Area by, const language::WheelRatios& ratios) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const bool follows = is_set(ratios.lu_per_count, axis) && value_of_axis(ratios.lu_per_count, axis) != 0;
    if (follows && device_.granted(device_.axis(axis).holder, Request::mpg_line) == Grant::waits)
      return Begun::taken;
  }
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (!is_set(ratios.lu_per_count, axis)) continue;
    AxisState& state = device_.axis(axis);
    const std::int32_t ratio = value_of_axis(ratios.lu_per_count, axis);
    if (ratio == 0) {
      if (state.wheel == WheelSource::mpg_line) device_.stop_axis(axis);
      continue;
    }
    if (state.wheel == WheelSource::mpg_line) {
      state.wheel_lu = ratio;
    } else if (device_.granted(state.holder, Request::mpg_line) == Grant::starts) {
      state.mover = mover_of(by);
      device_.start_wheel(axis, WheelSource::mpg_line);
      state.wheel_lu = ratio;
      if (state.holder != Activity::wheel) {
        state.mover = Mover::hand;
        return Begun::refused;
      }
    } else {
      device_.report(Code::axis_taken, mover_of(by));
      continue;
    }
    state.mover = mover_of(by);
  }
  return Begun::done;
}

// ---- what runs

bool ProgramMachine::is_running(Area by) const { return device_.is_awaited_by(mover_of(by)); }

void ProgramMachine::hold(Area by) {
  if (by == Area::c) device_.hold_path();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (device_.axis(axis).mover == mover_of(by) && !device_.is_on_path(axis)) device_.hold_axis(axis);
  }
}

void ProgramMachine::go_on(Area by) {
  if (by == Area::c) device_.go_on_path();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (device_.axis(axis).mover == mover_of(by) && !device_.is_on_path(axis)) device_.go_on_axis(axis);
  }
}

void ProgramMachine::drop_held(Area by) {
  if (by == Area::c && device_.state().path_is_held) device_.stop_path();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    AxisState& state = device_.axis(axis);
    if (state.mover == mover_of(by) && state.is_held) device_.stop_axis(axis);
  }
}

language::Areas ProgramMachine::stop(Area area) {
  language::Areas lost = 0;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (device_.manual_motion(axis) && (area == Area::c || language::axis_of(area) == axis)) {
      device_.handle(axis, area == Area::c ? ManualEvent::stop_of_c : ManualEvent::stop);
      continue;
    }
    const AxisState& state = device_.axis(axis);
    const Mover mover = state.mover;
    const bool is_meant = area == Area::c ? mover == Mover::c : language::axis_of(area) == axis;
    if (!is_meant || state.holder == Activity::nobody) continue;
    const bool is_others =
        mover < Mover::plc && mover != mover_of(area) && state.awaited &&
        (device_.is_on_path(axis) || !device_.chose(option("axis_stop_in_c", "stops_the_axis_alone")));
    device_.stop_by_command(axis);
    if (!is_others) continue;
    lost = static_cast<language::Areas>(lost | language::one(static_cast<Area>(mover)));
    device_.stop_all_of(mover);
  }
  return lost;
}

void ProgramMachine::waits_no_more(Area by) {
  for (AxisState& state : device_.state().axes) {
    if (state.mover == mover_of(by)) state.awaited = false;
    if (state.stop_awaited_by == mover_of(by)) state.stop_awaited_by = Mover::hand;
  }
}

// ---- both

bool ProgramMachine::set_positions(const language::SetPositions& positions) {
  bool has_changed = false;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (!is_set(positions.position_lu, axis)) continue;
    const std::int32_t wanted = value_of_axis(positions.position_lu, axis);
    if (positions.of_machine) {
      const auto pulses = device_.registers().scale(axis).to_pulses(wanted).value_or(0);
      has_changed = has_changed || pulses != device_.machine_pulses(axis);
      device_.set_counter(axis, 0, static_cast<std::int32_t>(pulses));
    } else if (device_.work_lu(axis) != wanted) {
      has_changed = true;
      device_.set_work_lu(axis, wanted);
    }
  }
  return has_changed;
}

}  // namespace understudy::emulator::models::super_40nc
