// The fields of an EEPROM's state (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include "base/state/fields.h"
#include "emulator/device/memory/eeprom.h"

namespace understudy {

template <>
struct StateOf<emulator::Eeprom::Slot> {
  static constexpr auto last = emulator::Eeprom::Slot::at_once;
};

template <>
struct StateOf<emulator::Eeprom::Job> {
  using Value = emulator::Eeprom::Job;
  static constexpr auto fields = FieldList{field<&Value::slot>(), field<&Value::takes>()};
};

template <>
struct StateOf<emulator::Eeprom> {
  using Value = emulator::Eeprom;
  static constexpr auto fields =
      FieldList{field<&Value::content_>(),   field<&Value::slots_>(),   field<&Value::jobs_>(),
                field<&Value::rewriting_>(), field<&Value::done_at_>(), field<&Value::revision_>(),
                field<&Value::writing_>()};
  static constexpr std::size_t members = 7;
  static void name_all(Value& all) {  // does not compile if a member is missing
    [[maybe_unused]] auto& [done_at, revision, content, slots, jobs, rewriting, writing] = all;
  }
};

}  // namespace understudy
