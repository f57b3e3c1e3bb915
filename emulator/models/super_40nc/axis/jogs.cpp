#include "emulator/models/super_40nc/axis/jogs.h"

#include <array>
#include <cstddef>

#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "interpreter/super_40nc/error.h"
#include "motion/move.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// The chip's mode of motion (PRMD).
constexpr int kModeContinuous = 0x00;
constexpr int kModeNegative = 0x08;  // added for negative direction

}  // namespace

motion::SpeedLaw Jogs::jog_law(int axis) const {
  const Settings settings = registers();
  const std::array<StoredRegister, 3> speeds{stored_x(d9x::kJogLow), stored_x(d9x::kJogMedium),
                                             stored_x(d9x::kJogHigh)};
  const bool is_medium = chose(option("jog_selector", "always_medium"));
  const StoredRegister chosen =
      is_medium ? speeds[1] : speeds[static_cast<std::size_t>(settings.of(stored_d(d8::kUserData2)))];
  return settings.law(axis, static_cast<double>(settings.of(chosen, axis)));
}

void Jogs::change_jog_speed() {
  if (!chose(option("jog_selector", "d8022_also_while_it_runs"))) return;
  for (int number = 0; number < kAxisCount; ++number) {
    const AxisState& state = axis(number);
    const bool is_asked = state.asked_by_contact || state.asked_by_plc;
    if (state.holder == Activity::jog && is_asked) chip(number).change_speed(jog_law(number), now());
  }
}

void Jogs::start_jog(int axis_number, int direction, bool AxisState::*asked_by) {
  AxisState& state = axis(axis_number);
  const Grant given = starts_.ask(axis_number, Request::jog);
  const motion::SpeedLaw law = jog_law(axis_number);
  if (given == Grant::continues_if_same_kind) {
    if (chip(axis_number).last_direction != direction) {
      report(Code::axis_taken);
      return;
    }
    chip(axis_number).resume(law, now());
    state.*asked_by = true;
    return;
  }
  if (given != Grant::starts) return;
  starts_.prepare(axis_number);
  starts_.begun(axis_number, chip(axis_number).run(direction, law, before_motion()), Activity::jog);
  if (state.holder != Activity::jog) return;
  state.*asked_by = true;
  starts_.mirror_start(axis_number, kModeContinuous + (direction < 0 ? kModeNegative : 0), 0, law);
}

void Jogs::release_jog(int axis_number, bool AxisState::*asked_by) {
  AxisState& state = axis(axis_number);
  if (state.holder != Activity::jog || !(state.*asked_by)) return;
  state.*asked_by = false;
  if (!state.asked_by_contact && !state.asked_by_plc) chip(axis_number).slow_down(now());
}

}  // namespace understudy::emulator::models::super_40nc
