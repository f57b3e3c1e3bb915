// All state of a SUPER-40NC, as one value.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/contacts.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/settings.h"
#include "emulator/models/super_40nc/user_table.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/step_programs.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/environment.h"

namespace understudy::emulator::models::super_40nc {

using interpreter::super_40nc::Area;
using interpreter::super_40nc::Code;

/// The error that D8094 to D8096 show.
struct ErrorReport {
  Code code = Code::none;
  std::int32_t step = 0;
  Area area = Area::plc;  // area of the step program's line; plc: a line of the PLC, or no line
  std::int32_t other_step = 0;
  Tick tick = -1;  // of several errors in one tick the first one stays

  bool operator==(const ErrorReport&) const = default;
};

/// Outputs that show for some time that something has finished (《X45.》, 《X46.》, 《C4.》, 《C5.》).
inline constexpr std::size_t kSignalCount = 10;
inline constexpr std::size_t kFirstEndSignal = 4;
inline constexpr std::size_t kPathSignal = 8;
inline constexpr std::size_t kEndOfCSignal = 9;

/// An operation of the panel's HOME or ZERO key, which starts the axes by their order numbers.
struct OrderKey {
  bool runs = false;
  std::int8_t order = 0;  // order number of the axes now moving
  bool has_failed = false;

  bool operator==(const OrderKey&) const = default;
};

struct State {
  bool touched = true;      // something was written since the last scan
  bool run_switch = false;  // PLC_RUN, as sampled in this tick
  bool emergency = false;   // CEMG
  bool has_ticked = false;  // at least one tick has run since power-up
  bool emergency_obeyed = false;
  std::array<bool, kAxisCount> were_held{};  // axes held in reset in the last scan
  bool was_inhibited = false;                // by M8004, in the last scan
  bool wheel_selected = false;               // D8020 or D8021 was written since the last scan
  std::array<std::int32_t, 3> analog{};
  std::int32_t wheel_edges = 0;  // MPG, as sampled
  std::array<motion::Axis, kAxisCount> chips{};
  std::array<motion::Environment, kAxisCount> environment{};
  std::array<AxisState, kAxisCount> axes{};
  motion::Coordinated path;  // LIN and arcs of C
  bool path_is_held = false;
  Tick path_backlash_ticks = 0;     // ticks for which backlash is sent before the path
  std::int32_t path_feed_lu_s = 0;  // F as it was when the path began
  double path_feed_scale = 1;       // LU along the path for a unit of F
  double path_limit_lu_s = 1;       // speed at which one axis reaches its highest speed
  interpreter::super_40nc::PlcState plc;
  Tick plc_quiet_scans = 0;  // coming scans that would only count, unless something they read changes
  interpreter::super_40nc::StepStates steps;
  Contacts contacts;
  ErrorReport error;
  std::array<Tick, kSignalCount> signal_until{};
  std::array<std::uint32_t, 2> receive_errors{};  // by port
  OrderKey homing_by_key;
  OrderKey zeroing_by_key;
  Tick logo_at = kNever;  // when M8502 comes on
  bool logo_over = false;
  bool file_changed = false;  // M8023 is ON for the next scan
  bool shows_file_changed = false;
  std::int32_t file = 0;          // the loaded file, as D9001 selects it
  bool file_is_left_out = false;  // the loaded file is too long: it is not in memory and stays unchanged
  std::int32_t recipe = 0;        // as D9002 selects it
  std::array<std::int32_t, kAxisCount> rpm_at_power_up{};  // X14
  std::int32_t logo_ms = 0;                                // C0, as it was at power-up
  std::int32_t station = 0;                                // D9000, as it was at power-up
  std::vector<std::uint32_t> parameters_in_force;          // if written ones act later; else empty
  Tick flash_until = 0;                                    // no scan before this, while the flash is written
  std::array<Tick, kAxisCount> erc_until{};
  std::array<bool, kAxisCount> clears_seen{};   // CLR, as sampled
  std::array<bool, kAxisCount> latches_seen{};  // LTC
  UserTable table;
  Eeprom eeprom;
  TextBlocks blocks;
  Image image{};

  bool operator==(const State&) const = default;
};

}  // namespace understudy::emulator::models::super_40nc
