// Return the course of a recording as data for drawings: curves and spans (docs/control.md#a-recording).
#pragma once

#include "emulator/serve/control/message_fields.h"
#include "emulator/world/events/history.h"
#include "emulator/world/events/story.h"
#include "emulator/world/recording/timeline.h"
#include "emulator/world/world.h"

namespace understudy::emulator::serve {

/// {"do":"curves","names":["feeder.A.position"],"from_ns":0,"to_ns":6000000000,"dots":1000}. Replays the
/// stretch in `other`, a world from the same bench.
Json curves_message(const Json& message, const world::Timeline& timeline, world::World& other);

/// {"do":"spans","from_ns":0,"to_ns":6000000000,"dots":1000,"from":0}
Json spans_message(const Json& message, const world::Timeline& timeline, world::World& other,
                   const world::History& history, const world::Story* story);

Json json_of(const world::Story& story);

}  // namespace understudy::emulator::serve
