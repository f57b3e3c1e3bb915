// Models one serial line. Bytes from the host reach every station after their time on the wire; bytes from
// the stations reach the host the same way. Pure: it uses simulated time, and no descriptors.
//
//   host bytes --receive()--> [wire, one character at a time] --> every Station
//   Station::run() --transmit()--> [wire] --> output() --> host
//
// The two directions do not disturb each other. A station never receives another station's reply as bytes,
// only a notice that one is being sent: a reply to "write single register" is the same frame as its request,
// and slaves that answer every address would take each other's replies for requests without end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/queue.h"
#include "pty/line_observer.h"
#include "pty/line_settings.h"
#include "pty/station.h"

namespace understudy::pty {

enum class Timing : std::uint8_t {
  wire,     // every character takes as long as the line's baud rate requires
  instant,  // characters arrive and leave immediately
};

struct LineOptions {
  LineSettings settings;
  Timing timing = Timing::wire;
  bool echoes = false;           // the host receives its own bytes
  bool enforce_settings = true;  // a station is deaf to a host with other settings
  std::int64_t baud_tolerance_ppm = kUsualBaudTolerancePpm;  // a speed that differs by less counts as equal
};

/// An adapter between the wire and the host. The default one passes everything on at once.
struct Adapter {
  bool echoes = false;  // the host receives its own bytes, even without the line's option
  // The host receives bytes at multiples of this time, or when the buffer is full; 0: at once.
  SimTime latency{0};
  bool is_unplugged = false;  // no byte passes in either direction

  bool operator==(const Adapter&) const = default;
};

struct LineCounters {
  std::uint64_t bytes_in = 0;         // from the host
  std::uint64_t bytes_out = 0;        // to the host
  std::uint64_t bytes_unheard = 0;    // from a host whose settings match no station's
  std::uint64_t bytes_discarded = 0;  // to the host, dropped because the host did not read them
  std::uint64_t collisions = 0;       // transmissions that overlapped another station's (wire timing only)
};

class Line {
 public:
  static constexpr std::size_t kInputCapacity = 1024;   // bytes by which the host may be ahead of the wire
  static constexpr std::size_t kOutputCapacity = 4096;  // bytes waiting for the host
  static constexpr std::size_t kLump = 62;  // bytes that an adapter holds back, as USB adapters do

  /// `warn` receives one clear sentence for each problem that the user should know about (a deaf station, a
  /// host that has set no speed, a collision), once each time a host opens the line. Throws
  /// std::invalid_argument if the baud rate is not positive.
  Line(std::string name, LineOptions options, std::function<void(const std::string&)> warn);

  /// Adds a station, which must outlive the line. Stations receive and transmit in the order of attaching.
  void attach(Station& station);
  /// Drops the characters that a station has not begun to send, because it has lost its power.
  void discard_pending(const Station& station, SimTime now);
  /// Sets how the host is connected to the wire from now on.
  void set_adapter(const Adapter& adapter);
  bool is_unplugged() const { return state_.adapter.is_unplugged; }
  /// Sets the wire's speed from now on. Characters in transit keep their times.
  void set_settings(const LineSettings& settings);
  /// Notifies `observer` of the traffic on the wire, until it is removed. Observers are called in the order
  /// of adding.
  void add_observer(LineObserver& observer);
  void remove_observer(LineObserver& observer);
  /// Passes the strike to the observers. It has no other effect.
  void report_strike(const StruckMessage& message);

  // --- the host's side -----------------------------------------------------------------------
  /// Returns how many bytes receive() can take now. The rest must wait in the pty, because buffers are
  /// bounded.
  std::size_t room() const;
  /// Takes bytes that the host has written, seen at `now`. The first begins at `now`, or when the character
  /// before it has ended. Bytes beyond room() are ignored.
  void receive(std::span<const std::uint8_t> bytes, SimTime now);
  /// Like receive(), for bytes of a host that has since closed the line.
  void receive_departed(std::span<const std::uint8_t> bytes, SimTime now);

  /// The host flushes its output: characters that are not on the wire yet are never sent.
  void host_purged();

  /// Reports that the clock is stopped, and that no byte has arrived for as long as a station waits for a
  /// frame (Station::on_idle). It has no effect while characters are in transit.
  void nothing_more(SimTime now);

  /// A host opened the line. The previous host's settings are forgotten. A new line counts as opened.
  void host_opened();
  /// Sets what the host has configured, or nothing if it did not set the line's speed. It holds for
  /// characters that begin from now on.
  void host_settings(std::optional<HostSettings> settings);
  /// The last host closed the line. Bytes on their way to it are dropped, as are the stations' transmissions
  /// until the next host opens the line. Bytes that the host has written still arrive, including those
  /// received before the next host opens; replies to them are dropped and never reach the next host.
  void host_closed();

  /// Returns the bytes that have completely left the wire towards the host and were not taken yet: at most
  /// kOutputCapacity. Further ones are discarded and counted.
  std::span<const std::uint8_t> output() const;
  void take_output(std::size_t count);

  // --- time ----------------------------------------------------------------------------------
  std::optional<SimTime> due() const;
  /// Call this after the due() of a station or an observer has changed for any reason other than a call from
  /// the line.
  void due_changed() { next_.reset(); }
  /// Processes everything that is due at `now` or earlier, in chronological order. At equal times the order
  /// is: characters that arrive, observers, stations in the order of attaching, characters that leave. With
  /// Timing::instant stations come before the next character, so that requests in one lump are served one by
  /// one.
  void run(SimTime now);

  const std::string& name() const { return name_; }
  /// Returns the options in effect, including a speed that set_settings() has changed.
  LineOptions options() const;
  const LineCounters& counters() const { return state_.edge.counters; }
  bool is_host_open() const { return state_.is_host_open; }
  /// The settings last reported for the host that has the line open, if there are any.
  const std::optional<HostSettings>& settings_of_host() const { return state_.host_settings; }

  // --- its state: its stations and observers have their own states ----------------------------
  // Characters sent back to back. They are timed from the first one, so that rounding errors do not add up.
  struct Burst {
    SimTime start{0};
    std::int64_t count = 0;
    SimTime end{0};
  };
  /// The line's data about a station.
  struct Member {
    bool is_deaf = false;                 // the station does not receive the character on the wire
    Burst transmission;                   // its last transmission
    std::optional<SimTime> noticed_at{};  // when the other stations notice that it transmits
  };
  struct Warned {
    bool of_deafness = false;
    bool of_no_speed = false;
    bool of_collision = false;
  };
  /// The part of the state that depends on the reader of the line; it never affects the stations.
  struct Edge {
    Queue<std::uint8_t> output;  // waiting to be taken
    LineCounters counters;
    SimTime clock{0};  // the time of the last event
  };
  struct State {
    LineSettings settings;
    std::vector<Member> members;  // in the order of attaching
    bool is_host_open = true;
    std::optional<HostSettings> host_settings;
    std::optional<HostSettings> departed_settings;  // the settings of the previous host
    std::uint64_t last_departed = 0;                // the number of that host's last character
    std::uint64_t last_received = 0;                // the number of the last character of any host
    Warned warned;
    Queue<TimedByte> input;  // from the host, on the wire or before it, the first one next
    Burst arriving;
    bool is_received = true;   // at least one station receives the character that arrives
    Queue<TimedByte> leaving;  // to the host, on the wire, in chronological order; numbered by their stations
    Adapter adapter;
    Queue<std::uint8_t> lump;          // held back by the adapter
    std::optional<SimTime> lump_at{};  // when the adapter delivers it
    Edge edge;
  };
  const State& save() const { return state_; }
  /// Throws std::invalid_argument if this line cannot be in that state.
  void check(const State& state) const;
  /// Checks the state, then puts it into effect. If it throws, nothing has changed.
  void restore(const State& state);

 private:
  class LineTransmitter;
  enum class What : std::uint8_t {
    nothing,
    character_in,
    observer,
    station,
    character_out,
    lump_out,
    notice
  };
  struct Event {
    What what = What::nothing;
    SimTime at{0};
    std::size_t member = 0;
  };

  bool is_instant() const { return options_.timing == Timing::instant; }
  const Event& next_event() const;
  Event find_next_event() const;
  void handle(const Event& event);
  void take(std::span<const std::uint8_t> bytes, SimTime now, bool is_departed);
  TimedByte place(Burst& burst, std::uint8_t value, SimTime now) const;
  void begin_character(SimTime at);
  void deliver_characters();
  void deliver_character();
  void report_character();
  std::size_t quiet_characters() const;
  void run_station(std::size_t index);
  void transmit(std::size_t index, std::span<const std::uint8_t> bytes, bool is_anybody_listening,
                std::uint64_t last_character);
  void put_on_wire(const TimedByte& character, bool& has_collided);
  void notify_others(std::size_t sender);
  void leave_wire(std::span<const std::uint8_t> bytes);
  void give_lump();
  void give_host(std::span<const std::uint8_t> bytes);
  void discard_unsent();
  void warn_once(bool& has_warned, std::string_view what);
  void warn_deaf(std::size_t index, const HostSettings& settings, const LineSettings& expected);

  std::string name_;
  LineOptions options_;  // except for the settings
  std::function<void(const std::string&)> warn_;
  std::vector<Station*> stations_;
  std::vector<LineObserver*> observers_;
  State state_;
  // A cache of the next event. Most stations wait for nothing, but would be asked in every tick.
  mutable std::optional<Event> next_{};
  std::size_t notices_ = 0;  // members whose noticed_at is set
};

}  // namespace understudy::pty
