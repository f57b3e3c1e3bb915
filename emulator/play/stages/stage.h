// Where a scenario is played: a world whose time is moved on, and a host on its lines. There are two: one in
// free time on the line itself (free_stage.h), and one in real time over a real pty with libmodbus as the
// host (real_stage.h). A performance is the same on both, and the verdicts must be the same too.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/world/speech/text_lines_heard.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

/// What came back after a request.
struct HostReply {
  enum class Kind : std::uint8_t {
    good,
    exception,  // `exception` says which
    silence,    // nothing in time
    garbled,    // bytes that are not an answer to it
  } kind = Kind::silence;
  int exception = 0;
  std::vector<std::uint16_t> words;  // what was read; a bit each where it was bits
  std::vector<std::uint8_t>
      bytes;  // as they came, checksum and all (free time), or what the host made of them
};

/// Something that may come true at the end of a tick.
struct Awaited {
  std::function<bool(world::World&)> is_there;
  /// As TickWatcher::next_look; none: it may come true at any tick, even if nothing happens.
  std::function<Tick(Tick)> next_look{};
};

class Stage {
 public:
  virtual ~Stage() = default;

  // --- the host: as a master on a line, one request at a time, t3.5 and `gap` after whatever was on it
  // before. Each call lasts, in simulated time, until the reply has come or time runs out.
  virtual HostReply read(std::size_t line, int station, Table table, std::uint16_t first, int count) = 0;
  /// To coils or holding registers.
  virtual HostReply write(std::size_t line, int station, Table table, std::uint16_t first,
                          std::span<const std::uint16_t> words) = 0;
  /// To holding registers that take a request as one message: by function 10, whatever their number.
  virtual HostReply write_message(std::size_t line, int station, std::uint16_t first,
                                  std::span<const std::uint16_t> words) = 0;
  /// Sends raw bytes; returns what comes back until there are `wanted` bytes, or `within` has passed.
  virtual std::vector<std::uint8_t> exchange(std::size_t line, std::span<const std::uint8_t> bytes,
                                             std::size_t wanted, SimTime within) = 0;

  // --- the host on a line of text
  /// Sends a line (its end is added) as soon as the gap allows. What came before is discarded. Returns when
  /// the device has heard it.
  virtual void say(std::size_t line, const std::string& text) = 0;
  /// Also listens for the answer, or (without `text`) only listens: until it has come, or something else
  /// instead, or `within` has passed. Lines after that are heard by the next call; an answer is everything
  /// that comes without a pause. The last line may be unfinished.
  virtual std::vector<std::string> converse(std::size_t line, const std::optional<std::string>& text,
                                            const world::LinesWanted& wanted, SimTime within) = 0;

  // --- the world -------------------------------------------------------------------------------------
  /// Acts on the world between two ticks, or looks at it. What `act` throws comes out here.
  virtual void with_world(const std::function<void(world::World&)>& act) = 0;
  /// Lets time pass until it is there at the end of a tick (or now), at most to `deadline`; returns whether
  /// it is. `is_there` is called at every tick that may be different, on whatever thread runs the world.
  virtual bool run_until(const Awaited& awaited, SimTime deadline) = 0;
  virtual void advance(SimTime by) = 0;
  virtual SimTime now() = 0;
  /// The tick from which the host's last write acts.
  virtual Tick tick_of_last_write() = 0;

  /// Since when each line has been quiet, as far as the host knows. The world's state does not contain this,
  /// and the host's next request depends on it. Empty for a host in real time, which nobody sets back.
  virtual std::vector<SimTime> quiet_since() { return {}; }
  /// Sets what another stage of this bench returned when its world was in the state that this world was just
  /// put into.
  virtual void set_quiet_since(const std::vector<SimTime>&) {}
};

}  // namespace understudy::emulator::play
