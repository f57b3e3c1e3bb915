// RS-M8194H: its whole state, as a value.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/fields.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/eeprom_fields.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/paths.h"
#include "emulator/models/rs_m8194h/registers.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/triggers.h"
#include "interpreter/rs_m8194h/window.h"
#include "motion/axis.h"
#include "motion/surroundings.h"
#include "motion/synchronous.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

inline constexpr int kFifoBlocks = 30;

/// Commands that wait for their turn, and the STOP_WAIT that has begun and left it.
struct Fifo {
  std::vector<lang::Command> waiting{};
  AxisMask stop_wait = 0;

  bool operator==(const Fifo&) const = default;
};

/// Whether it is an interpolation (path_commands.cpp).
bool is_path(const lang::Command& command);
struct HeldPath;
/// Whether it is a segment of the same stream.
bool follows(const HeldPath& first, const HeldPath& other);
/// Whether it is a segment of a stream, and its last one.
bool is_segment(const HeldPath& path);
bool is_last_segment(const HeldPath& path);

/// An interpolation that is held, on the axes that it was sent for.
struct HeldPath {
  lang::Command command{};
  std::array<std::uint8_t, 3> codes{};

  bool operator==(const HeldPath&) const = default;
};

/// Equal triggers along an axis (7.4.12).
struct LineScan {
  bool set = false;
  std::uint8_t type = 0;
  std::int32_t pitch = 0;
  bool running = false;
  std::int64_t begin = 0;      // travel where it began
  std::int64_t triggered = 0;  // places passed
  // What SET_OUT had said of its pin.
  std::uint8_t level_before = 0;
  std::uint8_t width_before = 0;

  bool operator==(const LineScan&) const = default;
};

/// Where interrupts are counted, no more of them wait.
inline constexpr std::size_t kMostMarks = 256;

/// An interrupt that waits for its ISR.
struct IsrMark {
  static constexpr std::uint8_t kSynchronous = 8;
  static constexpr std::uint8_t kCalled = 9;  // MP_ISR_CALL

  Tick tick = 0;
  std::uint8_t axis = 0;
  std::uint8_t source = 0;  // nINT 0 to 7, or one of the above
  std::uint8_t number = 0;  // of a call, or as bound at the event

  auto operator<=>(const IsrMark&) const = default;
};

/// Bits of RINT_STATE (12.1.8).
enum class Rint : std::uint8_t {
  line_scan,
  mp_completed,
  user,
  stream,
  reserved_4,
  reserved_5,
  axes,
  module
};
constexpr std::uint8_t bit_of(Rint bit) {
  return static_cast<std::uint8_t>(1U << static_cast<unsigned>(bit));
}

/// States of the module that are passed within a tick (4.16.2).
inline constexpr std::uint8_t kInitialised = 2;
inline constexpr std::uint8_t kDownloaded = 4;
inline constexpr std::uint8_t kMpFinished = 6;
inline constexpr std::uint8_t kIsrFinished = 8;

/// An axis and a source in one number.
constexpr std::uint8_t name_of_source(std::size_t axis, std::uint8_t source) {
  return static_cast<std::uint8_t>(axis << 4U | source);
}

/// None is being downloaded: a name all the same, as each download has one.
inline const lang::Download kNoDownload{.name = {.is_isr = false, .number = 1}};

/// Which macro, which command, which line, which error: inputs 115 to 119.
using MacroReport = std::array<std::uint16_t, 5>;

struct State {
  std::array<motion::Axis, kAxes> motors{};
  std::array<motion::Surroundings, kAxes> here{};
  std::array<AxisUnit, kAxes> units{};
  motion::SyncTable sync{};
  Paths paths{};
  std::array<LineScan, kAxes> scans{};
  AxisMask scanning = 0;  // axes that LINE_SCAN_START has named
  Fifo fifo{};
  std::vector<HeldPath> held_paths{};  // what waits for DRV_START; behind a segment those of its stream
  std::vector<HeldPath> loaded{};  // of the stream that runs: its segment, and those that are ready behind it
  // The RS-M8194H's own.
  lang::State rsm = lang::State::ready;
  std::uint16_t illegal_reason = 0;
  lang::Download download = kNoDownload;  // while `rsm` says so
  lang::DownloadStatus downloaded{};
  // The module's.
  bool emergency_state = false;
  bool emergency_input = false;  // EMG is active,
  Tick emergency_since = 0;      // or not, since then
  std::uint8_t rint = 0;         // without bit 6, which follows the error codes
  bool interrupts = false;       // ENABLE_INT
  std::array<AxisMask, kFactors> factor_axes{};
  std::vector<IsrMark> marks{};
  std::vector<std::uint8_t> enabled{};  // what calls ISRs, by name_of_source(), in the order of its enabling
  lang::Execution execution{};
  MacroReport execution_fault{};
  bool paused = false;                                        // by a trigger,
  std::uint8_t paused_by = 0;                                 // of this channel
  std::vector<std::uint8_t> queued_triggers{};                // channels whose MP waits for its turn
  std::array<AxisMask, lang::kTriggerCount> trigger_holds{};  // axes that a level of a channel holds
  std::array<std::uint16_t, kFrnetGroups> outputs{};          // as set,
  std::array<std::uint16_t, kFrnetGroups> sent{};             // as the last scan has sent them,
  std::array<std::uint16_t, kFrnetGroups> inputs{};           // as it has found them
  Tick powered_at = 0;
  bool at_init = false;       // the switch, as power-up found it
  bool unscanned = false;     // inputs of FRnet are not as the last scan has found them
  bool holds_back = false;    // a filter holds a level of an input back
  std::uint8_t finished = 0;  // of the states that are passed, the last one,
  Tick finished_at = 0;       // and when
  Tick resetting_until = 0;   // RESET_CARD
  int steps_left = 0;         // of this tick
  bool touched = false;       // by a command at once since then: what waits may go on
  std::array<std::uint16_t, kWindowWords> parameters{};  // written before their command, by choice
  // Non-volatile.
  std::array<BasicSettings, kAxes> initial_table{};
  TextBlocks blocks{};  // macros, triggers and the Initial Table, as text
  Eeprom eeprom{};
  std::vector<std::uint32_t> image{};

  bool operator==(const State&) const = default;
};

}  // namespace understudy::emulator::models::rs_m8194h
