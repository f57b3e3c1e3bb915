// The fields of a described controller's state (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include "base/state/fields.h"
#include "emulator/device/memory/eeprom_fields.h"
#include "emulator/models/imported/axis_drive.h"
#include "emulator/models/imported/device.h"
#include "motion/state_fields.h"

namespace understudy {

template <>
struct StateOf<emulator::models::imported::AxisState> {
  using Value = emulator::models::imported::AxisState;
  static constexpr auto fields = FieldList{field<&Value::motor>(),
                                           field<&Value::environment>(),
                                           field<&Value::counter>(),
                                           field<&Value::sent_pulses>(),
                                           field<&Value::encoder_counts>(),
                                           field<&Value::run_pps>(),
                                           field<&Value::wanted_direction>(),
                                           field<&Value::direction_is_spent>(),
                                           field<&Value::arrived>(),
                                           field<&Value::homed>()};
};

template <>
struct StateOf<emulator::models::imported::State> {
  using Value = emulator::models::imported::State;
  static constexpr auto fields =
      FieldList{field<&Value::touched>(), field<&Value::image>(),    field<&Value::held>(),
                field<&Value::axes>(),    field<&Value::followed>(), field<&Value::eeprom>()};
};

}  // namespace understudy
