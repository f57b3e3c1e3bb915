// Observes random courses, and stops them wherever possible.
#pragma once

#include "emulator/world/debug/breakpoint.h"
#include "emulator/world/debug/debugger.h"
#include "emulator/world/debug/program_lines.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

/// A debugger whose breakpoints stop at many lines, and which steps from each stop.
struct StoppingDebugger {
  explicit StoppingDebugger(World& of)
      : world(of), frames(of, 64), events(of, frames), debugger(of, events) {}

  void set_some() {
    debugger.remove_all();
    const ProgramLines lines(world.device(0));
    for (int line = 1; line < 12 && lines.line_from(line) != 0; line += 2)
      debugger.add({.line = line, .nth = static_cast<std::uint64_t>(line) % 4 + 1});
    debugger.add({.kind = BreakpointSetup::Kind::event, .name = "program-error"});
    debugger.add({.kind = BreakpointSetup::Kind::condition, .condition = "time / 1ms % 7 == 0"});
  }
  void step(int number) {
    constexpr StepKind kKinds[] = {StepKind::instruction, StepKind::line, StepKind::over, StepKind::out,
                                   StepKind::stand};
    try {
      debugger.begin_step(kKinds[number % 5], 0, "");
    } catch (const BreakpointError&) {  // no power, no routine
    }
  }

  World& world;
  FrameLog frames;
  EventLog events;
  Debugger debugger;
};

}  // namespace understudy::emulator::world
