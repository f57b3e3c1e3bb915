// The parts of a SUPER-40NC, which work on its state. Each part may use only the parts before it.
#pragma once

#include "emulator/device/device.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/models/super_40nc/axis/axis_parts.h"
#include "emulator/models/super_40nc/commands.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/panel/hand_moves.h"
#include "emulator/models/super_40nc/panel/pressed_keys.h"
#include "emulator/models/super_40nc/path/moves.h"
#include "emulator/models/super_40nc/path/paths.h"
#include "emulator/models/super_40nc/programs/programs.h"
#include "emulator/models/super_40nc/state.h"

namespace understudy::emulator::models::super_40nc {

struct Parts {
  Parts(const Device& device, RegisterBank& bank, State& state)
      : ground(device, state, state.steps),
        axes(Chips(ground, state)),
        paths(axes, state),
        moves(axes, paths),
        keys(axes.chips, state),
        hands(axes, moves, keys, state),
        programs({ground, axes, paths, moves, keys, bank}, state),
        commands({ground, axes, paths, moves, keys, bank}, hands, programs, state, state) {}
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  Ground ground;
  AxisParts axes;
  Paths paths;
  Moves moves;
  PressedKeys keys;
  HandMoves hands;
  Programs programs;
  Commands commands;
};

}  // namespace understudy::emulator::models::super_40nc
