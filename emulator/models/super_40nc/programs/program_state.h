// The programs of a SUPER-40NC at run time, and the flash that stores them, as a value.
#pragma once

#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/models/super_40nc/programs/user_table.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/step_programs.h"

namespace understudy::emulator::models::super_40nc {

struct ProgramState {
  interpreter::super_40nc::PlcState plc;
  Tick plc_quiet_scans = 0;  // how many scans would only count, unless something that they read changes
  interpreter::super_40nc::StepStates steps;
  bool file_changed = false;  // M8023 is ON for the next scan
  bool shows_file_changed = false;
  std::int32_t file = 0;          // the loaded file, selected by D9001
  bool file_is_left_out = false;  // the loaded file is too long, so it is not in memory and does not change
  std::int32_t recipe = 0;        // the recipe that D9002 selects
  Tick flash_until = 0;           // no scan before this tick, because the flash is being written
  UserTable table;
  TextBlocks blocks;

  bool operator==(const ProgramState&) const = default;
};

}  // namespace understudy::emulator::models::super_40nc
