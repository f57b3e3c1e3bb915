#include "emulator/models/super_40nc/axis/axis_flags.h"

#include <cstdint>

#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/effects.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/terminals.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::super_40nc {

bool AxisFlags::status(int axis_number, AxisStatus what) const {
  const AxisState& state = axis(axis_number);
  const motion::Axis& motor = chip(axis_number);
  switch (what) {
    case SSCM: return state.holder != Activity::nobody;
    case SRUN: {
      const std::int32_t operation = operation_of(axis_number);
      return operation == kByWheel ? state.followed_pulses != 0 : operation != kStopped;
    }
    case SENI:
      return !chose(option("seni_flag", "always_0")) && state.has_ended && state.holder == Activity::nobody;
    case SEND: return state.holder == Activity::nobody;
    case SERR: return state.has_error;
    case SCP1: return comparators_.comparator_holds(axis_number, 0);
    case SCP2: return comparators_.comparator_holds(axis_number, 1);
    case SCP3: return comparators_.comparator_holds(axis_number, 2);
    case SCP4: return comparators_.comparator_holds(axis_number, 3);
    case SCP5: return comparators_.comparator_holds(axis_number, 4);
    case SFU: return operation_of(axis_number) == kSpeedingUp;
    case SFD: return operation_of(axis_number) == kSlowingDown;
    case SFC: {
      const std::int32_t operation = operation_of(axis_number);
      return operation == kAtFa || operation == kAtFl || operation == kAtFh || operation == kBacklash;
    }
    case SALM: return has_signal(axis_number, motion::Signal::alarm);
    case SPEL: return has_signal(axis_number, motion::Signal::limit_plus);
    case SMEL: return has_signal(axis_number, motion::Signal::limit_minus);
    case SORG: return has_signal(axis_number, motion::Signal::home);
    case SDIR: return motor.last_direction < 0;
    case SEMG: return ground_.state().emergency;
    case SERC: return pins_.gives_erc(axis_number);
    case SCLR: return pins_.has_chip_pins() && input(chip_pin_of(axis_number, kClearPin)) != 0;
    case SLTC: return pins_.has_chip_pins() && input(chip_pin_of(axis_number, kLatchPin)) != 0;
    case SEZ: return has_signal(axis_number, motion::Signal::index);
    case SINP: return input(pin_of(axis_number, kInPositionPin)) != 0;
    case SRDY: return input(pin_of(axis_number, kReadyPin)) != 0;
    case HOME_DONE: return state.homed;
    case ZERO_DONE: return state.zeroed;
    case HOME_RUNS: return state.holder == Activity::home && shows_running(state.mover == Mover::hand);
    case ZERO_RUNS: return state.holder == Activity::zero;
    case WHEEL_RUNS: {
      const bool is_by_contact =
          state.wheel >= WheelSource::contact_1 && state.wheel <= WheelSource::contact_100;
      return state.holder == Activity::wheel && shows_running(is_by_contact);
    }
  }
  return false;
}

bool AxisFlags::shows_running(bool is_by_contact) const {
  return is_by_contact || !chose(option("motion_flags_source", "contacts_alone"));
}

}  // namespace understudy::emulator::models::super_40nc
