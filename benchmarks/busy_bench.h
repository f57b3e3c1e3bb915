// Worlds of busy Simple2-R3: their axes move in various ways while a program executes a line every 2 ms.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "emulator/world/world.h"

namespace understudy::benchmarks {

/// The motion of both axes of every device, until the world ends.
enum class Activity {
  positions,  // long position moves back and forth, started again by the program
  velocity,   // velocity mode, up and down a ramp
  sync,       // following encoders, which turn_encoders() must turn
  homing,     // away from a home switch, and homing again
  waiting,    // at rest; the program waits for an input
  idle,       // at rest, without a program
};
std::string_view name_of(Activity activity);

/// Fifteen stations per line, at 19200 baud. Every device has machines with limit switches, a home switch and
/// an encoder on both axes, except where the encoders are turned by hand. Throws CannotRun.
std::unique_ptr<emulator::world::World> make_busy_world(std::size_t devices, Activity activity);

/// Starts a move of an hour, at 267 pulses per second, in a world of one idle device.
void begin_hour_long_move(emulator::world::World& world);

/// Turns the encoders of Activity::sync to their positions at `tick`.
void turn_encoders(emulator::world::World& world, Tick tick);

}  // namespace understudy::benchmarks
