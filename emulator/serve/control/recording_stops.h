// Moves forward and backward in a recording to the stops of a debugger.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "base/simulated_time.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/world/debug/breakpoint.h"
#include "emulator/world/debug/debugger.h"
#include "emulator/world/recording/timeline.h"

namespace understudy::emulator::serve {

/// Returns true if the message contains "back":true. Throws MessageError if "back" is neither true nor false.
bool is_way_back(const Json& message);

class RecordingStops {
 public:
  /// `go_to` moves the world to a time. The daemon and the timeline must outlive this object.
  RecordingStops(Daemon& daemon, world::Timeline& timeline, std::function<void(SimTime)> go_to);

  /// {"do":"continue","within":"10s"}, {"do":"continue","back":true}. If there is no stop, goes to the end,
  /// or back to the beginning.
  Json resume(const Json& message);
  /// {"do":"step","what":"line","device":"feeder"}, {"do":"step","what":"line","back":true}, and steps in
  /// ticks.
  Json step(const Json& message);

 private:
  struct Wanted {
    world::StepKind kind = world::StepKind::line;
    std::size_t device = 0;
    std::string program{};
  };
  /// Plays until the next stop, but at most until `until`. Returns false if there was no stop.
  using PlayOn = std::function<bool(SimTime until)>;
  /// Returns true if the search is looking for this stop.
  using IsWanted = std::function<bool(const world::DebugStop& stop)>;

  Wanted wanted_step(const Json& message) const;
  bool play_on(SimTime until);
  bool step_on(const Wanted& wanted, SimTime until);
  void go_back(const PlayOn& play, const IsWanted& is_wanted);
  std::optional<std::size_t> last_stop(std::size_t keyframe, SimTime before, const PlayOn& play,
                                       const IsWanted& is_wanted);
  void begin_at(std::size_t keyframe);
  world::Debugger& debugger() const;
  SimTime now() const;

  Daemon& daemon_;
  world::Timeline& timeline_;
  std::function<void(SimTime)> go_to_;
};

}  // namespace understudy::emulator::serve
