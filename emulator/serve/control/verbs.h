// The control messages that are not about registers, each with its reply. If one throws (MessageError or
// NameError), nothing has changed.
#pragma once

#include <functional>
#include <string_view>

#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/telling.h"

namespace understudy::emulator::serve {

/// The version of the messages and replies, MAJOR.MINOR. A change that breaks no client raises MINOR, any
/// other change raises MAJOR. docs/control.md lists the changes.
inline constexpr std::string_view kControlProtocol = "1.0";

/// Replies with the result of `make`, or with the reason why there is none; null means that there is no reply
/// yet.
void answer(const ControlServer::Reply& reply, const std::function<Json()>& make);

Telling status_message(Daemon& daemon, Json message);
/// {"do":"identify"}: which daemon this is
Json identify_message(Daemon& daemon, const Json& message);
/// {"do":"frames","since":17}: those that went over the lines, from number 17 on; {"do":"frames","last":10}
Telling frames_message(Daemon& daemon, Json message);

/// {"do":"get","names":["feeder.Cord_A","feeder.A.position","time"]}: whatever conditions can name
Telling get_message(Daemon& daemon, Json message);
/// {"do":"eval","expression":"feeder.Cord_A / 3200"}
Json eval_message(Daemon& daemon, const Json& message);
/// {"do":"set","values":{"feeder.Aaxis_Speed":200}}
Json set_message(Daemon& daemon, const Json& message);

/// {"do":"input","values":{"feeder.DIN_10":1,"feeder.AIN_A":"2.5V"}}
Json input_message(Daemon& daemon, const Json& message);
/// {"do":"turn","values":{"mill.MPG":400},"in":"2s"}; without a time at once
Json turn_message(Daemon& daemon, const Json& message);
/// {"do":"command","device":"mill","text":"MOVE X 1000"}
Json command_message(Daemon& daemon, const Json& message);
/// {"do":"power","device":"feeder","to":"off"}, "on" or "cycle"
Json power_message(Daemon& daemon, const Json& message);
/// {"do":"program","device":"feeder","text":"..."}; without a text the reply brings the one there is
void program_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"inject","fault":{"lost_steps":"feeder.A","one_in":50}}, as a bench has it
Json inject_message(Daemon& daemon, const Json& message);
/// {"do":"clear","number":1}; without a number all of them
Json clear_message(Daemon& daemon, const Json& message);
/// {"do":"list"}
Json list_message(Daemon& daemon, const Json& message);

/// {"do":"snapshot","file":"/tmp/homed.json"}: an absolute path. The file is written beside the daemon; the
/// reply comes when it is there.
void snapshot_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"restore","file":"/tmp/homed.json"}. The file is read beside the daemon; the reply comes when the
/// world is what it was.
void restore_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);

/// {"do":"pause"}, {"do":"resume"}
Json pause_message(Daemon& daemon, const Json& message);
Json resume_message(Daemon& daemon, const Json& message);
/// {"do":"advance","by":"250ms"}. The reply comes when simulated time is there.
void advance_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"step","ticks":10}: to the end of the tenth tick from now, where the clock stands.
void step_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"run-until","condition":"feeder.STATUS.4 == 0","within":"10s"}. The reply comes at the end of the
/// first tick at which it is true, or when the time is over; "reached" says which.
void run_until_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);

}  // namespace understudy::emulator::serve
