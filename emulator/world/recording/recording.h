// A recording contains everything that reached a world from outside and everything that its stations sent,
// with simulated times. It consists of JSON lines: a header, followed by one event per line, in order. See
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

/// The beginning of a recording, which is enough to recreate the world.
struct RecordingHeader {
  std::string version;  // the version of the program that recorded it
  std::string bench;    // in the form of bench_text.h, including memories
  WorldOptions options;
  std::uint64_t seed = 0;
  /// The state of the world (snapshot_file.h) if it ran before the recording began; otherwise empty.
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
    settings,  // a host set `host`; if that has no value, it left the settings unchanged
    bytes,     // a host wrote `bytes`
    departed,  // like `bytes`, from a host that has since closed the line
    purged,    // a host flushed bytes that were not on the line yet
    nothing_more,
    sent,     // stations sent `bytes` on the line, which a replay must match
    input,    // terminal `place` of device `where` was set to `value`
    power,    // the device was switched to `value`
    inject,   // `fault` was injected
    clear,    // fault number `value` was cleared
    write,    // `write` was executed without using the line
    assign,   // the value `text` of a device without registers was set to `real`
    program,  // the program `text` was loaded; the device refused it if `value` is not 0
    command,  // the command `text` was executed without using the line
    wait,     // thread `where` of a host in simulated time has waited since `since` (`text`)
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

/// Return one line without its line ending.
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
