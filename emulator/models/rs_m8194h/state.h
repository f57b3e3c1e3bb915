// RS-M8194H: the whole state, as a value.
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
#include "motion/environment.h"
#include "motion/synchronous.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

inline constexpr int kFifoBlocks = 30;

/// The commands that wait for their turn, and the axes of a STOP_WAIT that has begun and left the queue.
struct Fifo {
  std::vector<lang::Command> waiting{};
  AxisMask stop_wait = 0;

  bool operator==(const Fifo&) const = default;
};

/// Returns true if the command is an interpolation (path_commands.cpp).
bool is_path(const lang::Command& command);
struct HeldPath;
/// Returns true if `other` is a segment of the same stream.
bool follows(const HeldPath& first, const HeldPath& other);
/// Return true if the path is a segment of a stream, and if it is the last one.
bool is_segment(const HeldPath& path);
bool is_last_segment(const HeldPath& path);

/// A held interpolation, with the axes for which it was sent.
struct HeldPath {
  lang::Command command{};
  std::array<std::uint8_t, 3> codes{};

  bool operator==(const HeldPath&) const = default;
};

/// Triggers at equal distances along an axis (7.4.12).
struct LineScan {
  bool set = false;
  std::uint8_t type = 0;
  std::int32_t pitch = 0;
  bool running = false;
  std::int64_t begin = 0;      // travel at which it began
  std::int64_t triggered = 0;  // trigger positions passed
  // The settings of SET_OUT for its pin.
  std::uint8_t level_before = 0;
  std::uint8_t width_before = 0;

  bool operator==(const LineScan&) const = default;
};

/// The most interrupts that wait, if they are counted.
inline constexpr std::size_t kMaxMarks = 256;

/// An interrupt that waits for its ISR.
struct IsrMark {
  static constexpr std::uint8_t kSynchronous = 8;
  static constexpr std::uint8_t kCalled = 9;  // MP_ISR_CALL

  Tick tick = 0;
  std::uint8_t axis = 0;
  std::uint8_t source = 0;  // nINT 0 to 7, or one of the above
  std::uint8_t number = 0;  // number of the ISR: of a call, or as bound at the event

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

/// States of the module that pass within a tick (4.16.2).
inline constexpr std::uint8_t kInitialised = 2;
inline constexpr std::uint8_t kDownloaded = 4;
inline constexpr std::uint8_t kMpFinished = 6;
inline constexpr std::uint8_t kIsrFinished = 8;

/// Returns an axis and a source as one number.
constexpr std::uint8_t name_of_source(std::size_t axis, std::uint8_t source) {
  return static_cast<std::uint8_t>(axis << 4U | source);
}

/// The value for "no download". It has a name because each download has one.
inline const lang::Download kNoDownload{.name = {.is_isr = false, .number = 1}};

/// Inputs 115 to 119: the macro, the command, the line and the error.
using MacroReport = std::array<std::uint16_t, 5>;

struct State {
  std::array<motion::Axis, kAxes> motors{};
  std::array<motion::Environment, kAxes> environment{};
  std::array<AxisUnit, kAxes> units{};
  motion::SyncTable sync{};
  Paths paths{};
  std::array<LineScan, kAxes> scans{};
  AxisMask scanning = 0;  // axes of LINE_SCAN_START
  Fifo fifo{};
  // paths that wait for DRV_START; a segment is followed by those of its stream
  std::vector<HeldPath> held_paths{};
  // segments of the running stream: the current one and those ready behind it
  std::vector<HeldPath> loaded{};
  // State of the RS-M8194H itself.
  lang::State rsm = lang::State::ready;
  std::uint16_t illegal_reason = 0;
  lang::Download download = kNoDownload;  // valid while `rsm` says that a download is open
  lang::DownloadStatus downloaded{};
  // State of the module.
  bool emergency_state = false;
  bool emergency_input = false;  // true: EMG is active,
  Tick emergency_since = 0;      // since this tick; false: not active since this tick
  std::uint8_t rint = 0;         // without bit 6, which follows from the error codes
  bool interrupts = false;       // ENABLE_INT
  std::array<AxisMask, kFactors> factor_axes{};
  std::vector<IsrMark> marks{};
  // sources of ISRs, by name_of_source(), in the order in which they were enabled
  std::vector<std::uint8_t> enabled{};
  lang::Execution execution{};
  MacroReport execution_fault{};
  bool paused = false;                                        // paused by a trigger
  std::uint8_t paused_by = 0;                                 // channel of that trigger
  std::vector<std::uint8_t> queued_triggers{};                // channels whose MP waits for its turn
  std::array<AxisMask, lang::kTriggerCount> trigger_holds{};  // axes that the level of a channel holds
  std::array<std::uint16_t, kFrnetGroups> outputs{};          // as set
  std::array<std::uint16_t, kFrnetGroups> sent{};             // as sent by the last scan
  std::array<std::uint16_t, kFrnetGroups> inputs{};           // as found by the last scan
  Tick powered_at = 0;
  bool at_init = false;       // the switch, as found at power-up
  bool unscanned = false;     // FRnet inputs differ from those of the last scan
  bool holds_back = false;    // a filter holds back the level of an input
  std::uint8_t finished = 0;  // the last state that has passed within a tick,
  Tick finished_at = 0;       // and its tick
  Tick resetting_until = 0;   // end of RESET_CARD
  int steps_left = 0;         // steps left in this tick
  bool touched = false;  // an immediate command has run since the last tick, so waiting commands may continue
  std::array<std::uint16_t, kWindowWords> parameters{};  // by choice: parameters written before their command
  // Non-volatile.
  std::array<BasicSettings, kAxes> initial_table{};
  TextBlocks blocks{};  // macros, triggers and the Initial Table, as text
  Eeprom eeprom{};
  std::vector<std::uint32_t> image{};

  bool operator==(const State&) const = default;
};

}  // namespace understudy::emulator::models::rs_m8194h
