// The fields of a described controller's state (base/state/fields.h), in the order of the bytes.
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
  static constexpr auto fields = FieldList{field("motor", &Value::motor),
                                           field("here", &Value::environment),
                                           field("counter", &Value::counter),
                                           field("sent_pulses", &Value::sent_pulses),
                                           field("encoder_counts", &Value::encoder_counts),
                                           field("run_pps", &Value::run_pps),
                                           field("wanted_way", &Value::wanted_direction),
                                           field("way_is_spent", &Value::direction_is_spent),
                                           field("arrived", &Value::arrived),
                                           field("homed", &Value::homed)};
};

template <>
struct StateOf<emulator::models::imported::State> {
  using Value = emulator::models::imported::State;
  static constexpr auto fields =
      FieldList{field("touched", &Value::touched),   field("image", &Value::image),
                field("held", &Value::held),         field("axes", &Value::axes),
                field("followed", &Value::followed), field("eeprom", &Value::eeprom)};
};

}  // namespace understudy
