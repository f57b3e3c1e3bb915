// A world with a debugger, and a program in its first device.
#pragma once

#include <string>
#include <vector>

#include "emulator/device/user_program.h"
#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/debug/debugger.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

struct DebuggedWorld {
  explicit DebuggedWorld(const std::string& model, const std::string& program = "",
                         const std::string& more = "")
      : world(parse_bench(models::all_models(),
                          "understudy: 1\nlines: { a: { timing: instant, stations: [ { name: m, model: " +
                              model + " } ] } }\n" + more,
                          "bench.yaml", "."),
              {}, {}) {
    if (!program.empty()) world.load_program(0, program);
  }

  /// Advances until the next stop, for at most `ms`. Returns the stop's text, or an empty text if there was
  /// none.
  std::string run(std::int64_t ms) {
    world.advance_to(world.now() + std::chrono::milliseconds(ms));
    return debugger.take_stop() ? debugger.stop()->text : std::string();
  }
  /// Steps, and returns where the step ended.
  std::string step(StepKind kind, const std::string& program = "", std::int64_t ms = 1000) {
    debugger.begin_step(kind, 0, program);
    const std::string text = run(ms);
    debugger.end_step();
    return text;
  }
  std::vector<std::string> reported(std::string_view what) {
    std::vector<std::string> texts;
    for (const Event& event : events.since(1, SIZE_MAX)) {
      if (event.what == what) texts.push_back(event.text);
    }
    return texts;
  }

  World world;
  FrameLog frames{world, 256};
  EventLog events{world, frames};
  Debugger debugger{world, events};
};

}  // namespace understudy::emulator::world
