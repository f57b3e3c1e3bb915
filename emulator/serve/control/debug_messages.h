// The control messages of a debugger (docs/debugging.md). As in verbs.h, a function that throws has changed
// nothing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/server.h"
#include "emulator/world/debug/breakpoint.h"

namespace understudy::emulator::serve {

inline constexpr std::string_view kRunsByItself =
    "time is already running; expected --speed manual, or `pause` first";

/// {"do":"break","device":"feeder","line":12,"when":"...","nth":3,"log":"..."} sets a breakpoint; so does
/// "instruction", "write" or "on" instead of "line", or "when" alone. {"do":"break"} lists them,
/// {"do":"break","delete":1} deletes one, or "all".
Json break_message(Daemon& daemon, const Json& message);
/// {"do":"continue"} lets time run; {"do":"continue","within":"10s"} advances it; the reply then follows at
/// the next stop, or when that time is over.
void continue_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"step","ticks":10} runs to the end of the tenth tick from now; {"do":"step","what":"line",
/// "device":"feeder","within":"10s"} to the program's next line. The clock must be stopped.
void step_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"stack","device":"feeder"}: the positions of the device's programs, and their callers.
Json stack_message(Daemon& daemon, const Json& message);
/// {"do":"source","device":"feeder"}: the text of the device's program. `break` and `stack` use its line
/// numbers. "instructions":true adds the instructions of each program.
Json source_message(Daemon& daemon, const Json& message);
/// {"do":"variables","device":"feeder","scope":"axes"}: the values of the names in the device's program, of
/// its axes, or of its terminals; without "scope", all of these.
Json variables_message(Daemon& daemon, const Json& message);

inline constexpr std::uint64_t kMaxStepTicks = 3'600'000;  // an hour

/// Returns the device of the message, which must have power and run programs. Throws MessageError.
const Device& require_program(Daemon& daemon, const Json& message);
/// Returns the kind of step under "what". Throws MessageError.
world::StepKind require_step_kind(const Json& message);
/// Returns a duration from now on. Throws MessageError.
SimTime require_duration(const Daemon& daemon, const Json& message, const std::string& key);
/// Returns the world's present stop, or null.
Json json_of_stop(const Daemon& daemon);
/// Returns the time, and the stop if the world is at one.
Json time_and_stop(const Daemon& daemon);

}  // namespace understudy::emulator::serve
