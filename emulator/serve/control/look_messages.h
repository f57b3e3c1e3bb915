// The control messages that onlookers live on, such as the page (docs/page.md): what there is on a bench, how
// it is doing, what has happened. Like verbs.h: if one throws, nothing has changed.
#pragma once

#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/telling.h"

namespace understudy::emulator::serve {

/// {"do":"look","names":[...],"frames":17,"events":3,"status":true}: all that an onlooker wants at once,
/// cheap to ask many times a second. A name that has no value is null. {"do":"look","look":5,...}: the names
/// of an earlier look, by its number.
Telling look_message(Daemon& daemon, Json message);

/// {"do":"bench"}: lines, devices, wires; {"do":"bench","device":"feeder"}: that device's axes and terminals
Telling bench_message(Daemon& daemon, Json message);
/// {"do":"registers","device":"feeder","section":2,"from":0,"find":"speed"}: rows of its tables, 200 at a
/// time
Telling registers_message(Daemon& daemon, Json message);
/// {"do":"get","device":"feeder","section":2,"from":0}: values of a page of them
Telling get_page_message(Daemon& daemon, Json message);
/// {"do":"choices","device":"feeder","from":0}
Telling choices_message(Daemon& daemon, Json message);
/// {"do":"faults"}: the kinds of faults, for a form
Telling faults_message(Daemon& daemon, Json message);

/// {"do":"events","since":17}, {"do":"events","last":10}
Telling events_message(Daemon& daemon, Json message);

/// {"do":"where","device":"feeder"}: what its programs do
Json where_message(Daemon& daemon, const Json& message);
/// {"do":"speed","to":"0.5"}
Json speed_message(Daemon& daemon, const Json& message);
/// {"do":"scope","names":[...],"condition":"...","before":"1s","after":"1s"} arms it; without names it tells
/// how far it is;
/// {"do":"scope","from":0} its samples; {"do":"scope","off":true}
Telling scope_message(Daemon& daemon, Json message);
/// {"do":"send","line":"rs485","bytes":"01 03 00 00 00 01","checksum":true}, or "text":"MA 100": to a line
/// that no host has
Json send_message(Daemon& daemon, const Json& message);
/// {"do":"snapshots"}: those that the daemon keeps by name
Json snapshots_message(Daemon& daemon, const Json& message);
/// {"do":"snapshot","name":"homed"}, {"do":"restore","name":"homed"}; "drop": forget it
Json snapshot_by_name(Daemon& daemon, const Json& message);
Json restore_by_name(Daemon& daemon, const Json& message);

}  // namespace understudy::emulator::serve
