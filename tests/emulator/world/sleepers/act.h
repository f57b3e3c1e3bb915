// An event from outside as a value, which can be applied to several worlds, and described.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "emulator/world/world.h"
#include "tests/emulator/world/sleepers/draw.h"

namespace understudy::emulator::world::sleepers {

struct Act {
  std::string words;  // its description in a course
  std::function<void(World&)> carry_out;
  SimTime before{0};  // time since the previous act
};

// Each of these acts does nothing if the world lacks the target or refuses the act.
Act write_act(const std::string& name, Value value);
Act assign_act(const std::string& name, double value);
Act command_act(const std::string& text);
Act line_act(const std::string& text);
Act program_act(const std::string& text);
Act frame_act(std::vector<std::uint8_t> bytes, std::size_t line = 0);

/// The events that any controller can receive, from everything that its model lists: registers, inputs,
/// faults, the power, frames. Device 0 is `m`, device 1 a neighbour.
Act any_act(Draw& draw, const Model& model);

}  // namespace understudy::emulator::world::sleepers
