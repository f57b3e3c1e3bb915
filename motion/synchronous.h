// Synchronous actions between axes: events on one axis make other axes start, stop or latch their positions.
//
// As on the MCX314, a trigger axis has factors (a mask of its events) and a mask of the axes it activates.
// Each axis has one action, which it performs when any trigger activates it. Source: RS-M8194H manual 7.3.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "motion/axis.h"
#include "motion/shared_tick.h"

namespace understudy::motion {

struct SyncAction {
  enum class Drive : std::uint8_t {
    none,
    fixed_plus,  // a move by `distance_pulses`; this and the next three require that the axis is at rest
    fixed_minus,
    endless_plus,
    endless_minus,
    slow_down,
    stop_at_once,
  };
  enum class Preset : std::uint8_t { none, command, encoder, distance, speed };

  Drive drive = Drive::none;
  bool latch_command = false;
  bool latch_encoder = false;
  Preset preset = Preset::none;
  std::int64_t preset_value = 0;  // a count, pulses, or pulses per second
  bool output = false;            // reported to the owner, which controls the pin
  bool interrupt = false;         // reported to the owner

  bool operator==(const SyncAction&) const = default;
};

/// The actions that up to four axes perform for each other. Axes are numbered 0 .. 3; masks have one bit per
/// axis.
struct SyncTable {
  static constexpr std::size_t kAxes = 4;

  struct Trigger {
    Events factors = 0;          // events of motion/axis.h; an MCX314 has the first eight
    std::uint8_t activates = 0;  // mask of axes
    bool operator==(const Trigger&) const = default;
  };
  struct Latch {
    bool taken = false;
    std::int64_t travel_pulses = 0;   // travel of the axis, if latch_command
    std::int64_t encoder_pulses = 0;  // the encoder count, if latch_encoder
    bool operator==(const Latch&) const = default;
  };

  std::array<Trigger, kAxes> triggers{};
  std::array<SyncAction, kAxes> actions{};
  std::array<Latch, kAxes> latches{};
  // Distance and speed of a drive action, set by the owner and by presets.
  std::array<std::int64_t, kAxes> distance_pulses{};
  std::array<SpeedLaw, kAxes> speeds{};

  bool operator==(const SyncTable&) const = default;
};

/// The part of the actions that the owner must perform.
struct SyncOutcome {
  Events fired = 0;                  // factors of the trigger that fired
  std::uint8_t outputs = 0;          // axes whose action has an output
  std::uint8_t interrupts = 0;       // axes whose action raises an interrupt
  std::uint8_t presets_command = 0;  // axes whose command count is to be set to preset_value
  std::uint8_t presets_encoder = 0;

  bool operator==(const SyncOutcome&) const = default;
};

/// Acts on events of the axis `trigger` at this moment. The activated axes are brought to this moment, in
/// order. Latches, stops and speeds have the values of this moment. A drive begins in the next tick, like a
/// drive that is commanded between ticks, and throws for speeds and distances that Axis::move() does not
/// accept. Axes that do not exist are omitted. Counters belong to the owner, so latches contain travel.
SyncOutcome act(SyncTable& table, std::size_t trigger, Events events, SharedTick& tick);

}  // namespace understudy::motion
