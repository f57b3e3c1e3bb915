// An executor runs a scenario: it has a world whose time it advances, and a host on the lines. There are
// executors in virtual time on the line itself (free_executor.h), in real time over a real pty with libmodbus
// as the host (real_executor.h), and with real controllers (box/stage/). A scenario must have the same
// verdict on all of them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/world/protocol/received_lines.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

/// The answer to a request.
struct HostReply {
  enum class Kind : std::uint8_t {
    good,
    exception,  // `exception` contains its code
    silence,    // no answer in time
    garbled,    // bytes that are not an answer to the request
  } kind = Kind::silence;
  int exception = 0;
  std::vector<std::uint16_t> words;  // the words that were read; in tables of bits, one word per bit
  std::vector<std::uint8_t> bytes;   // as received, with checksum; may be missing for a good reply
};

/// A condition that may become true at the end of a tick.
struct Awaited {
  std::function<bool(world::World&)> is_met;
  /// Like TickWatcher::next_poll(). If this is empty, the condition may become true in any tick, even if
  /// nothing happens.
  std::function<Tick(Tick)> next_poll{};
};

/// The command that runs with a scenario (`exec`). Its functions are called inside Executor::with_world().
class HostCommand {
 public:
  virtual ~HostCommand() = default;
  /// Returns nothing while the command is running.
  virtual std::optional<int> exit_code() const = 0;
  /// Asks the command to end.
  virtual void stop() = 0;
};

class RealBox;

class Executor {
 public:
  virtual ~Executor() = default;

  /// Returns the stage if the controllers are real, or null if the world emulates them. With real
  /// controllers, the world supplies only names, station numbers and the word order.
  virtual RealBox* box() { return nullptr; }

  // --- the host: a master on a line that sends one request at a time, t3.5 and `gap` after all earlier
  // traffic. In simulated time, each call lasts until the reply has arrived or the time is over.
  virtual HostReply read(std::size_t line, int station, Table table, std::uint16_t first, int count) = 0;
  /// Writes coils or holding registers.
  virtual HostReply write(std::size_t line, int station, Table table, std::uint16_t first,
                          std::span<const std::uint16_t> words) = 0;
  /// Writes holding registers that accept a request as one message, always with function 10.
  virtual HostReply write_message(std::size_t line, int station, std::uint16_t first,
                                  std::span<const std::uint16_t> words) = 0;
  /// Sends raw bytes. Returns the bytes that were received until there were `wanted` bytes, or until `within`
  /// had passed.
  virtual std::vector<std::uint8_t> exchange(std::size_t line, std::span<const std::uint8_t> bytes,
                                             std::size_t wanted, SimTime within) = 0;

  // --- the host on a line of text
  /// Sends a line with a line ending as soon as the gap allows. Bytes that were received earlier are
  /// discarded. Returns when the device has received the line.
  virtual void send_text(std::size_t line, const std::string& text) = 0;
  /// Sends a line if there is a `text`. Receives lines until the expected lines, or different lines in their
  /// place, have arrived, or until `within` has passed. Later lines are left for the next call. An answer
  /// consists of everything that arrives without a pause. The last line may be incomplete.
  virtual std::vector<std::string> exchange_text(std::size_t line, const std::optional<std::string>& text,
                                                 const world::LinesWanted& wanted, SimTime within) = 0;

  // --- the world -------------------------------------------------------------------------------------
  /// Acts on the world between two ticks, or reads it. Exceptions from `act` are passed on.
  virtual void with_world(const std::function<void(world::World&)>& act) = 0;
  /// Lets time pass until the condition is true at the end of a tick (or now), but not beyond `deadline`,
  /// which may be kForever. Returns true if the condition is true. `is_met` is called in every tick that may
  /// make a difference, on the thread that runs the world.
  virtual bool run_until(const Awaited& awaited, SimTime deadline) = 0;
  virtual void advance(SimTime by) = 0;
  virtual SimTime now() = 0;
  /// Returns the tick from which the last write of the host takes effect.
  virtual Tick tick_of_last_write() = 0;

  /// Returns the time since which each line has been quiet, as far as the host knows. This is not part of
  /// the world's state, but the host's next request depends on it. The result is empty for a host in real
  /// time, which cannot go back.
  virtual std::vector<SimTime> quiet_since() { return {}; }
  /// Sets the times that another executor for this bench returned when its world was in the state into which
  /// this world was just put.
  virtual void set_quiet_since(const std::vector<SimTime>&) {}
};

}  // namespace understudy::emulator::play
