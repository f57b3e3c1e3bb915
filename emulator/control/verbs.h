// The control messages that are not of registers, each with its reply. All throw MessageError or
// NameError, and have changed nothing then.
#pragma once

#include "emulator/control/message_fields.h"
#include "emulator/control/server.h"

namespace understudy::emulator {

Json status_message(Daemon& daemon, const Json& message);

/// {"do":"input","values":{"feeder.DIN_10":1,"feeder.AIN_A":"2.5V"}}
Json input_message(Daemon& daemon, const Json& message);
/// {"do":"power","device":"feeder","to":"off"}, "on" or "cycle"
Json power_message(Daemon& daemon, const Json& message);
/// {"do":"program","device":"feeder","text":"..."}; without a text the reply brings the one there is
Json program_message(Daemon& daemon, const Json& message);
/// {"do":"inject","fault":{"lost_steps":"feeder.A","one_in":50}}, as a bench has it
Json inject_message(Daemon& daemon, const Json& message);
/// {"do":"clear","number":1}; without a number all of them
Json clear_message(Daemon& daemon, const Json& message);
/// {"do":"list"}
Json list_message(Daemon& daemon, const Json& message);

/// {"do":"snapshot","file":"/tmp/homed.json"}: an absolute path
Json snapshot_message(Daemon& daemon, const Json& message);
/// {"do":"restore","file":"/tmp/homed.json"}
Json restore_message(Daemon& daemon, const Json& message);

/// {"do":"pause"}, {"do":"resume"}
Json pause_message(Daemon& daemon, const Json& message);
Json resume_message(Daemon& daemon, const Json& message);
/// {"do":"advance","by":"250ms"}. The reply comes when simulated time is there.
void advance_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);
/// {"do":"run-until","condition":"feeder.STATUS.4 == 0","within":"10s"}. The reply comes at the end of the
/// first tick at which it is true, or when the time is over; "reached" tells which.
void run_until_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply);

}  // namespace understudy::emulator
