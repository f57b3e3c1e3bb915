// A recording holds everything that reached a world from outside and everything that its stations sent, with
// simulated times. It consists of JSON lines: a header, then one event per line, in order. See
// docs/recordings.md.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

/// The beginning of a recording, which is enough to create the world again.
struct RecordingHeader {
  std::string version;  // the version of the program that recorded it
  std::string bench;    // in the form of bench_text.h, memories included
  WorldOptions options;
  std::uint64_t seed = 0;
  /// The world's state (snapshot_file.h) if the world ran before the recording began; otherwise empty.
  std::string snapshot;
};

/// The failure of a scenario that ends a recording.
struct RecordedFailure {
  std::string what{};  // "feeder.Cord_A is 31999; expected 32000"; empty: there was no failure
  SimTime at{0};
  std::string scenario{};  // including the name of its branch
  std::string place{};     // the step's place: "fail.yaml:8"
  std::string step{};      // "expect: feeder.Cord_A = 32000"
};

struct RecordedEvent {
  enum class What : std::uint8_t {
    opened,    // a host opened line `where`
    closed,    // a host closed line `where`
    settings,  // the host set `host`; no value: it left the settings unchanged
    bytes,     // a host wrote `bytes`
    departed,  // like `bytes`, from a host that has since closed the line
    purged,    // the host flushed bytes that were not on the wire yet
    nothing_more,
    sent,     // stations sent `bytes` on the line, which a replay must match
    input,    // terminal `place` of device `where` was set to `value`
    power,    // the device was switched to `value`
    inject,   // the fault `fault` was injected
    clear,    // fault number `value` was cleared
    write,    // `write` was made without using the line
    assign,   // a device without registers was given the value `real` by the name `text`
    program,  // a device was given the program `text`; the device refused it if `value` is not 0
    command,  // a device was given the command `text` without using the line
    wait,     // thread `where` of a host in simulated time has waited since `since`, as `text` describes
    end,      // the recording ends here; `text` is the final state (snapshot_file.h), or empty
  } what = What::end;
  SimTime at{0};
  SimTime since{0};
  std::size_t where = 0;
  int place = 0;
  std::int64_t value = 0;
  std::optional<pty::HostSettings> host{};
  std::vector<std::uint8_t> bytes{};
  std::string text{};
  RecordedFailure failed{};  // for `end`
  double real = 0;
  Fault fault{};
  PreparedWrite write{};
};

/// Returns one line without its line end.
std::string to_line(const RecordingHeader& header);
std::string to_line(const RecordedEvent& event, const KnownDevices& devices);

/// Reports a line that is neither a header nor an event: "field: what is wrong; what was expected".
struct RecordingError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
RecordingHeader parse_header(std::string_view text);
RecordedEvent parse_event(std::string_view text, const KnownDevices& devices, std::size_t line_count);

/// Applies an event to the world at the world's current time. `sent`, `wait` and `end` have no effect.
void apply(World& world, const RecordedEvent& event);

}  // namespace understudy::emulator::world
