// Where a scenario is played: a world whose time is moved on, and a host on its lines. There are two: one in
// free time on the line itself (free_stage.h), and one in real time over a real pty with libmodbus as the
// host (real_stage.h). The runner is the same for both, and so must the verdicts be.
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

/// What came back for a request.
struct HostReply {
  enum class Kind : std::uint8_t {
    good,
    exception,  // `exception` says which
    silence,    // nothing in time
    garbled,    // bytes that are no answer to it
  } kind = Kind::silence;
  int exception = 0;
  std::vector<std::uint16_t> words;  // what was read
  std::vector<std::uint8_t>
      bytes;  // as they came, checksum and all (free time), or what the host made of them
};

class Stage {
 public:
  virtual ~Stage() = default;

  // --- the host: as a master on a line, one request at a time, t3.5 and `gap` after whatever was on it
  // before.
  // --- Each call lasts, in simulated time, until the reply has come or its time is over.
  virtual HostReply read_registers(std::size_t line, int station, std::uint16_t first, int count) = 0;
  virtual HostReply write_registers(std::size_t line, int station, std::uint16_t first,
                                    std::span<const std::uint16_t> words) = 0;
  /// Bytes as they are; what comes back until `wanted` bytes are there, or `within` is over.
  virtual std::vector<std::uint8_t> exchange(std::size_t line, std::span<const std::uint8_t> bytes,
                                             std::size_t wanted, SimTime within) = 0;

  // --- the host on a line of text: says a line (its end is added) at once, but for the gap. What came before
  // is not heard any more.
  /// Lasts until the device has heard it.
  virtual void say(std::size_t line, const std::string& text) = 0;
  /// And hears what it says, or (without `text`) only hears: until that has come, or something else instead,
  /// or `within` is over. Lines behind that are heard next; an answer is all that comes without a pause. The
  /// last line may have no end.
  virtual std::vector<std::string> converse(std::size_t line, const std::optional<std::string>& text,
                                            const world::LinesWanted& wanted, SimTime within) = 0;

  // --- the world -------------------------------------------------------------------------------------
  /// Acts on the world between two ticks, or looks at it. What it throws comes out here.
  virtual void with_world(const std::function<void(world::World&)>& act) = 0;
  /// Lets time go on until `is_there` is true at the end of a tick (or is already), at most to `deadline`;
  /// true if it is. It is called at every tick, on whatever thread runs the world.
  virtual bool run_until(const std::function<bool(world::World&)>& is_there, SimTime deadline) = 0;
  virtual void advance(SimTime by) = 0;
  virtual SimTime now() = 0;
  /// When the last write that the host made was carried out, by the tick that it acts from.
  virtual Tick tick_of_last_write() = 0;

  /// Since when each line is quiet, as the host knows it: the world's state does not tell, and its next
  /// request depends on it. Empty for a host by the clock on the wall, which nobody sets back.
  virtual std::vector<SimTime> quiet_since() { return {}; }
  /// What another stage of this bench had when the world was in the state that it was just put into.
  virtual void set_quiet_since(const std::vector<SimTime>&) {}
};

}  // namespace understudy::emulator::play
