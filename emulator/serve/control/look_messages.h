// The control messages for observers such as the page (docs/page.md): the contents of the bench, its state,
// and its events. As in verbs.h, a function that throws has not changed anything.
#pragma once

#include <string_view>

#include "emulator/device/user_program.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"

namespace understudy::emulator::serve {

/// {"do":"look","names":[...],"frames":17,"events":3,"status":true}: everything that an observer needs at
/// once, fast enough for many requests per second. Names without a value are null. {"do":"look","look":5,...}
/// refers to the names in an earlier look by its number.
ReplyTask look_message(Daemon& daemon, Json message);

/// {"do":"bench"}: lines, devices, wires. {"do":"bench","device":"feeder"}: the axes and terminals of that
/// device.
ReplyTask bench_message(Daemon& daemon, Json message);
/// {"do":"registers","device":"feeder","section":2,"from":0,"find":"speed"}: rows of its tables, at most 200
/// at a time.
ReplyTask registers_message(Daemon& daemon, Json message);
/// {"do":"get","device":"feeder","section":2,"from":0}: the values of a page of registers.
ReplyTask get_page_message(Daemon& daemon, Json message);
/// {"do":"choices","device":"feeder","from":0}
ReplyTask choices_message(Daemon& daemon, Json message);
/// {"do":"faults"}: the kinds of faults, for a form.
ReplyTask faults_message(Daemon& daemon, Json message);

/// {"do":"events","since":17}, {"do":"events","last":10}
ReplyTask events_message(Daemon& daemon, Json message);

/// {"do":"spans","from_ns":0,"to_ns":6000000000,"dots":1000,"from":0}: what a host in simulated time has
/// waited for, and what it is waiting for now. Recordings have more spans (course_messages.h).
Json present_spans_message(Daemon& daemon, const Json& message);

/// Returns the word for the state of a program.
std::string_view state_word(ProgramLocation::State state);
/// {"do":"where","device":"feeder"}: the positions of the device's programs.
Json where_message(Daemon& daemon, const Json& message);
/// {"do":"coverage","device":"feeder"}: which program lines have run since counting began. Counting begins
/// with the first message, and again with "again":true.
ReplyTask coverage_message(Daemon& daemon, Json message);
/// {"do":"speed","to":"0.5"}
Json speed_message(Daemon& daemon, const Json& message);
/// {"do":"scope","names":[...],"condition":"...","before":"1s","after":"1s"} arms the scope. Without names,
/// it returns the progress. {"do":"scope","from":0} returns samples, and {"do":"scope","off":true} disarms
/// the scope.
ReplyTask scope_message(Daemon& daemon, Json message);
/// {"do":"send","line":"rs485","bytes":"01 03 00 00 00 01","checksum":true}, or "text":"MA 100": sends to a
/// line that has no host.
Json send_message(Daemon& daemon, const Json& message);
/// {"do":"snapshots"}: the snapshots that the daemon keeps by name.
Json snapshots_message(Daemon& daemon, const Json& message);
/// {"do":"snapshot","name":"homed"}, {"do":"restore","name":"homed"}; "drop" deletes the snapshot.
Json snapshot_by_name(Daemon& daemon, const Json& message);
Json restore_by_name(Daemon& daemon, const Json& message);

}  // namespace understudy::emulator::serve
