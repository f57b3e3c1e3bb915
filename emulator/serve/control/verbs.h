// The basic control messages; debug_messages.h and look_messages.h declare the other messages. Each function
// returns the reply. If a function throws MessageError or NameError, nothing has changed.
#pragma once

#include <functional>
#include <string_view>

#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/server.h"

namespace understudy::emulator::serve {

/// The version of messages and replies, MAJOR.MINOR. A change that breaks no client increments MINOR, any
/// other change increments MAJOR. docs/control.md lists the changes.
inline constexpr std::string_view kControlProtocol = "1.4";

/// Replies with the result of `make`, or with the reason if it throws an error. After a null result, the
/// reply is sent later.
void answer(const ControlServer::Reply& reply, const std::function<Json()>& make);

ReplyTask status_message(Daemon& daemon, Json message);
/// {"do":"identify"}: the daemon's process and version, and its lines.
Json identify_message(Daemon& daemon, const Json& message);
/// {"do":"frames","since":17}: frames on the lines from number 17 on; {"do":"frames","last":10}: the last
/// ten.
ReplyTask frames_message(Daemon& daemon, Json message);

/// {"do":"get","names":["feeder.Cord_A","feeder.A.position","time"]}: all names that conditions may use.
ReplyTask get_message(Daemon& daemon, Json message);
/// {"do":"eval","expression":"feeder.Cord_A / 3200"}
Json eval_message(Daemon& daemon, const Json& message);
/// {"do":"set","values":{"feeder.Aaxis_Speed":200}}
Json set_message(Daemon& daemon, const Json& message);

/// {"do":"input","values":{"feeder.DIN_10":1,"feeder.AIN_A":"2.5V"}}
Json input_message(Daemon& daemon, const Json& message);
/// {"do":"turn","values":{"mill.MPG":400},"in":"2s"}; without "in", immediately.
Json turn_message(Daemon& daemon, const Json& message);
/// {"do":"command","device":"mill","text":"MOVE X 1000"}
Json command_message(Daemon& daemon, const Json& message);
/// {"do":"power","device":"feeder","to":"off"}; "to" may also be "on" or "cycle".
Json power_message(Daemon& daemon, const Json& message);
/// {"do":"program","device":"feeder","text":"..."}; without "text", the reply contains the current program.
void program_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"inject","fault":{"lost_steps":"feeder.A","one_in":50}}; the fault is as in a bench.
Json inject_message(Daemon& daemon, const Json& message);
/// {"do":"clear","number":1}; without a number, all faults are cleared.
Json clear_message(Daemon& daemon, const Json& message);
/// {"do":"list"}
Json list_message(Daemon& daemon, const Json& message);

/// {"do":"snapshot","file":"/tmp/homed.json"} requires an absolute path. A helper thread writes the file, and
/// the reply is sent when the file exists.
void snapshot_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"restore","file":"/tmp/homed.json"}. A helper thread reads the file, and the reply is sent when the
/// world has that state.
void restore_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);

/// {"do":"pause"}, {"do":"resume"}
Json pause_message(Daemon& daemon, const Json& message);
Json resume_message(Daemon& daemon, const Json& message);
/// {"do":"advance","by":"250ms"}. The reply is sent when simulated time has advanced by that duration.
void advance_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"run-until","condition":"feeder.STATUS.4 == 0","within":"10s"}. The reply is sent at the end of the
/// first tick at which the condition is true, or when the time has passed. "reached" is true in the first
/// case.
void run_until_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);

}  // namespace understudy::emulator::serve
