// The control messages of a debugger (docs/debugging.md). As in verbs.h, a function that throws has not
// changed anything.
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

/// {"do":"break","device":"feeder","line":12,"when":"...","nth":3,"log":"..."} sets a breakpoint. Instead of
/// "line", it can have "instruction", "write" or "on", or only "when". {"do":"break"} lists the breakpoints,
/// and {"do":"break","delete":1} deletes one, or "all".
Json break_message(Daemon& daemon, const Json& message);
/// {"do":"continue"} lets time run. {"do":"continue","within":"10s"} advances it; the reply then follows at
/// the next stop, or when that time is over.
void continue_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"step","ticks":10} runs to the end of the tenth tick from now. {"do":"step","what":"line",
/// "device":"feeder","within":"10s"} runs to the next line of the program. The clock must be stopped.
void step_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"stack","device":"feeder"}: the positions of the device's programs, with their callers.
Json stack_message(Daemon& daemon, const Json& message);
/// {"do":"source","device":"feeder"}: the text of the device's program. `break` and `stack` use its line
/// numbers. With "instructions":true, it includes the instructions of each program.
Json source_message(Daemon& daemon, const Json& message);
/// {"do":"variables","device":"feeder","scope":"axes"}: the values of the names in the device's program, of
/// its axes, or of its terminals. Without "scope", all of these.
Json variables_message(Daemon& daemon, const Json& message);

inline constexpr std::uint64_t kMaxStepTicks = 3'600'000;  // an hour

/// Returns the device in the message, which must have power and run programs. Throws MessageError.
const Device& require_program(Daemon& daemon, const Json& message);
/// Returns the kind of step in "what". Throws MessageError.
world::StepKind require_step_kind(const Json& message);
/// Returns a duration from now on. Throws MessageError.
SimTime require_duration(const Daemon& daemon, const Json& message, const std::string& key);
/// Returns the present stop of the world, or null.
Json json_of_stop(const Daemon& daemon);
/// Returns the time, and the stop if the world is at one.
Json time_and_stop(const Daemon& daemon);

}  // namespace understudy::emulator::serve
