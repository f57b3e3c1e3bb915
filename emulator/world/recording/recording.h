// A recording: everything that reached a world from outside, and everything that its stations said, with
// simulated times. JSON lines: a header, then one event a line, in the order in which they happened.
// docs/recordings.md
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

/// What a recording begins with: enough to make the world again.
struct RecordingHeader {
  std::string version;  // of the program that recorded
  std::string bench;    // as bench_text.h has it, memories included
  WorldOptions options;
  std::uint64_t seed = 0;
  std::string snapshot;  // where it began later than the world: its state then (snapshot_file.h); else empty
};

struct RecordedEvent {
  enum class What : std::uint8_t {
    opened,    // a host opened line `where`
    closed,    // and closed it
    settings,  // set `host`; nothing: left them as they were
    bytes,     // wrote `bytes`
    departed,  // likewise, but has closed since
    purged,    // took back what was not on the wire yet
    nothing_more,
    said,     // `bytes` were said on the line: what a replay is compared with
    input,    // terminal `place` of device `where` was given `value`
    power,    // the device was switched to `value`
    inject,   // `fault`
    clear,    // fault number `value`
    write,    // `write`, past the line
    assign,   // the value `real` by the name `text`, to one without registers
    program,  // the device was given the program `text`; it refused it if there is a `value`
    command,  // and the command `text`, past the line
    end,      // the recording ends here; `text`: the state then (snapshot_file.h), or nothing
  } what = What::end;
  SimTime at{0};
  std::size_t where = 0;
  int place = 0;
  std::int64_t value = 0;
  std::optional<pty::HostSettings> host{};
  std::vector<std::uint8_t> bytes{};
  std::string text{};
  std::string failed{};  // of `end`: in what a scenario failed there
  double real = 0;
  Fault fault{};
  PreparedWrite write{};
};

/// One line, without its end.
std::string to_line(const RecordingHeader& header);
std::string to_line(const RecordedEvent& event, const KnownDevices& devices);

/// A line that is not a header or event: "field: what is wrong; what was expected".
struct RecordingError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
RecordingHeader parse_header(std::string_view text);
RecordedEvent parse_event(std::string_view text, const KnownDevices& devices, std::size_t line_count);

/// Does to the world what the event says (nothing for `said` and `end`), at the world's present time.
void apply(World& world, const RecordedEvent& event);

}  // namespace understudy::emulator::world
