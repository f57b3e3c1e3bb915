#include "emulator/models/super_40nc/programs/program_machine.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/path/manual_motions.h"
#include "emulator/models/super_40nc/rows/contact_rows.h"
#include "emulator/models/super_40nc/rows/data_rows.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/requests.h"

namespace understudy::emulator::models::super_40nc {

using language::Area;
using language::Begun;

namespace {

constexpr std::uint32_t cell_of_slot(StoredRegister kept) { return static_cast<std::uint32_t>(kept.slot); }

Mover mover_of(Area area) { return static_cast<Mover>(area); }

}  // namespace

// ---- contacts and registers

language::CellLayout ProgramMachine::layout() const {
  return {.x = cell_of_slot(kFirstX),
          .y = cell_of_slot(kFirstY),
          .m = cell_of_slot(kFirstM),
          .t = cell_of_slot(stored_at(Table::coil, kFirstTimerContact)),
          .c = cell_of_slot(stored_at(Table::coil, kFirstCounterContact)),
          .t_value = cell_of_slot(stored_at(Table::holding, kFirstTimerValue)),
          .c_value = cell_of_slot(stored_at(Table::holding, kFirstCounterValue)),
          .d = cell_of_slot(kFirstD)};
}

void ProgramMachine::retentive_cell_written(std::uint32_t cell) { ground_.keep_slot(cell); }

bool ProgramMachine::special_contact(int number) const {
  if (const std::size_t slot = relay_slot(number); slot != kNoSlot) return ground_.state().image[slot] != 0;
  return read_value(controls_.bank, controls_.bank.at(Table::coil, relay_address(number))) != 0;
}

bool ProgramMachine::set_special_contact(int number, bool on) {
  const std::size_t slot = relay_slot(number);
  if (slot == kNoSlot || special_contact(number) == on) return false;
  if (kIsUnlisted[slot] && !ground_.keeps_unlisted()) return false;
  ground_.set_contact(number, on);
  ground_.state().contacts.overwrite(number);
  ground_.keep_slot(slot);
  ground_.touch();
  return true;
}

std::int32_t ProgramMachine::special_register(int number) const {
  Place place = controls_.bank.at(Table::holding, data_address(number));
  place.part = Place::Part::whole;  // both words on the line
  return static_cast<std::int32_t>(read_value(controls_.bank, place));
}

bool ProgramMachine::set_special_register(int number, std::int32_t value) {
  const std::int32_t before = special_register(number);
  const auto bits = static_cast<std::uint32_t>(value);
  const std::array<std::uint16_t, 2> words{static_cast<std::uint16_t>(bits),
                                           static_cast<std::uint16_t>(bits >> 16)};
  write_words(controls_.bank, Table::holding, data_address(number), words);
  return special_register(number) != before;
}

std::int32_t ProgramMachine::parameter_in_force(int number) const {
  const std::vector<std::uint32_t>& in_force = ground_.state().parameters_in_force;
  if (in_force.empty()) return special_register(number);
  const Place place = controls_.bank.at(Table::holding, data_address(number));
  return static_cast<std::int32_t>(in_force[static_cast<std::size_t>(place.slot) - kFirstParameterSlot]);
}

std::int32_t ProgramMachine::rpm_at_power_up(int axis) const {
  return ground_.state().rpm_at_power_up[static_cast<std::size_t>(axis)];
}

void ProgramMachine::report(language::Code code, Area area, int step) {
  ground_.report({.code = code, .step = step, .area = area});
}

// ---- step programs

bool ProgramMachine::is_held_in_reset(Area area) const {
  const int axis = language::axis_of(area);
  return axis < 0 ? controls_.keys.is_stopped_by_emergency() : controls_.keys.is_held_in_reset(axis);
}

void ProgramMachine::program_starts(Area) { ground_.error_is_over(); }

void ProgramMachine::program_ended(Area area) {
  for (int axis = 0; axis < kAxisCount && chose(option("end_and_vdrv", "ends_by_its_ramp")); ++axis) {
    const AxisState& state = state_of(axis);
    if (state.holder == Activity::vdrv && state.mover == mover_of(area))
      controls_.moves.end_by_ramp(axis, Mover::hand);
  }
  ground_.show_finished(
      area == Area::c ? kEndOfCSignal : kFirstEndSignal + static_cast<std::size_t>(language::axis_of(area)));
}

template <class Start>
Begun ProgramMachine::begin_each(Area by, const language::AxisValues& values, Request request, Start start) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (is_set(values, axis) && granted(state_of(axis).holder, request) == Grant::waits) return Begun::taken;
  }
  bool has_begun = false;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (!is_set(values, axis)) continue;
    if (granted(state_of(axis).holder, request) != Grant::starts) {
      ground_.report(Code::axis_taken, mover_of(by));
      continue;
    }
    if (!start(axis, value_of_axis(values, axis))) {
      controls_.moves.break_program(mover_of(by));
      return Begun::refused;
    }
    has_begun = true;
  }
  if (is_awaited_by(mover_of(by))) return Begun::runs;
  return has_begun ? Begun::done : Begun::ignored;
}

Begun ProgramMachine::begin(Area by, const language::Drive& drive) {
  return begin_each(by, drive.target_lu, Request::line, [&](int axis, std::int32_t value) {
    const std::int64_t base = drive.targets == language::Targets::relative ? relative_base_lu(axis) : 0;
    const std::int32_t rpm = drive.rpm[static_cast<std::size_t>(axis)];
    if (!controls_.parts.drives.begin_drive(axis, base + value, rpm, mover_of(by))) return false;
    AxisState& state = state_of(axis);
    if (state.holder == Activity::move) state.awaited = drive.is_waited_for;
    return true;
  });
}

Begun ProgramMachine::begin(Area by, const language::MarkSearch& search) {
  return begin_each(by, search.target_lu, Request::line, [&](int axis, std::int32_t value) {
    const std::int64_t base = search.targets == language::Targets::relative ? relative_base_lu(axis) : 0;
    const std::int32_t rpm = search.rpm[static_cast<std::size_t>(axis)];
    const std::int64_t beyond = search_pulses(axis);
    const std::int64_t distance = distance_to(axis, base + value);
    const bool is_against = (beyond < 0 && distance > 0) || (beyond > 0 && distance < 0);
    if (is_against && chose(option("mrk_against", "void_with_a_code"))) {
      ground_.report(Code::out_of_range, mover_of(by));
      return true;
    }
    const bool begins = beyond == 0
                            ? controls_.parts.drives.begin_blind_mark(axis, base + value, rpm, mover_of(by))
                            : controls_.parts.drives.begin_mark(axis, distance, beyond, rpm, mover_of(by));
    if (begins && state_of(axis).holder == Activity::move) state_of(axis).awaited = true;
    return begins;
  });
}

Begun ProgramMachine::begin(Area by, const language::HomeSearch& search) {
  language::AxisValues values;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    if ((search.axes >> axis & 1U) != 0) values[axis] = 1;
  }
  return begin_each(by, values, Request::line, [&](int axis, std::int32_t) {
    AxisState& state = state_of(axis);
    state.mover = mover_of(by);
    controls_.parts.homes.start_home(axis);
    if (state.holder != Activity::home) return false;
    state.awaited = true;
    return true;
  });
}

Begun ProgramMachine::begin(Area by, const language::Rotation& rotation) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const bool turns = is_set(rotation.rpm, axis) && value_of_axis(rotation.rpm, axis) != 0;
    const Activity holder = state_of(axis).holder;
    const bool is_others =
        holder != Activity::nobody && holder != Activity::vdrv && holder != Activity::wheel;
    if (is_set(rotation.rpm, axis) && !turns && is_others && chose(option("vdrv_zero_others", "waits"))) {
      return Begun::taken;
    }
    if (turns && granted(state_of(axis).holder, Request::vdrv) == Grant::waits) return Begun::taken;
  }
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (!is_set(rotation.rpm, axis)) continue;
    const std::int32_t rpm = value_of_axis(rotation.rpm, axis);
    if (rpm == 0) {
      note_request(state_of(axis).holder, Request::vdrv_0);
      const bool is_at_once = chose(option("vdrv_zero_stop", "at_once"));
      is_at_once ? controls_.moves.stop_axis(axis) : void(controls_.moves.end_by_ramp(axis, mover_of(by)));
      continue;
    }
    const Grant given = granted(state_of(axis).holder, Request::vdrv);
    if (given == Grant::new_speed) {
      controls_.parts.drives.change_turning(axis, rpm, mover_of(by));
    } else if (given != Grant::starts) {
      ground_.report(Code::axis_taken, mover_of(by));
    } else if (!controls_.parts.drives.begin_turning(axis, rpm, mover_of(by))) {
      controls_.moves.break_program(mover_of(by));
      return Begun::refused;
    }
  }
  return is_awaited_by(mover_of(by)) ? Begun::runs : Begun::done;
}

Begun ProgramMachine::begin(Area by, const language::WheelRatios& ratios) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const bool follows = is_set(ratios.lu_per_count, axis) && value_of_axis(ratios.lu_per_count, axis) != 0;
    if (follows && granted(state_of(axis).holder, Request::mpg_line) == Grant::waits) return Begun::taken;
  }
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (!is_set(ratios.lu_per_count, axis)) continue;
    AxisState& state = state_of(axis);
    const std::int32_t ratio = value_of_axis(ratios.lu_per_count, axis);
    if (ratio == 0) {
      if (state.wheel == WheelSource::mpg_line) controls_.moves.stop_axis(axis);
      continue;
    }
    if (state.wheel == WheelSource::mpg_line) {
      state.wheel_lu = ratio;
    } else if (granted(state.holder, Request::mpg_line) == Grant::starts) {
      state.mover = mover_of(by);
      controls_.parts.wheel.start_wheel(axis, WheelSource::mpg_line);
      state.wheel_lu = ratio;
      if (state.holder != Activity::wheel) {
        state.mover = Mover::hand;
        return Begun::refused;
      }
    } else {
      ground_.report(Code::axis_taken, mover_of(by));
      continue;
    }
    state.mover = mover_of(by);
  }
  return Begun::done;
}

// ---- running motions

bool ProgramMachine::is_running(Area by) const { return is_awaited_by(mover_of(by)); }

void ProgramMachine::hold(Area by) {
  if (by == Area::c) controls_.paths.hold_path();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (state_of(axis).mover == mover_of(by) && !is_on_path(axis)) controls_.moves.hold_axis(axis);
  }
}

void ProgramMachine::resume_motions(Area by) {
  if (by == Area::c) controls_.paths.resume_path();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (state_of(axis).mover == mover_of(by) && !is_on_path(axis)) {
      if (const auto broken = controls_.moves.resume_axis(axis)) programs_.broken(*broken);
    }
  }
}

void ProgramMachine::drop_held(Area by) {
  if (by == Area::c && axes_.path_is_held) controls_.paths.stop_path();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    AxisState& state = state_of(axis);
    if (state.mover == mover_of(by) && state.is_held) controls_.moves.stop_axis(axis);
  }
}

language::Areas ProgramMachine::stop(Area area) {
  language::Areas lost = 0;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (controls_.moves.manual_motion(axis) && (area == Area::c || language::axis_of(area) == axis)) {
      controls_.moves.handle(axis, area == Area::c ? ManualEvent::stop_of_c : ManualEvent::stop);
      continue;
    }
    const AxisState& state = state_of(axis);
    const Mover mover = state.mover;
    const bool is_meant = area == Area::c ? mover == Mover::c : language::axis_of(area) == axis;
    if (!is_meant || state.holder == Activity::nobody) continue;
    const bool is_others = mover < Mover::plc && mover != mover_of(area) && state.awaited &&
                           (is_on_path(axis) || !chose(option("axis_stop_in_c", "stops_the_axis_alone")));
    controls_.moves.stop_by_command(axis);
    if (!is_others) continue;
    lost = static_cast<language::Areas>(lost | language::one(static_cast<Area>(mover)));
    controls_.moves.stop_all_of(mover);
  }
  return lost;
}

void ProgramMachine::waits_no_more(Area by) {
  for (AxisState& state : axes_.axes) {
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
      const auto pulses = registers().scale(axis).to_pulses(wanted).value_or(0);
      has_changed = has_changed || pulses != machine_pulses(axis);
      controls_.parts.parameters.set_counter(axis, 0, static_cast<std::int32_t>(pulses));
    } else if (work_lu(axis) != wanted) {
      has_changed = true;
      controls_.parts.parameters.set_work_lu(axis, wanted);
    }
  }
  return has_changed;
}

}  // namespace understudy::emulator::models::super_40nc
