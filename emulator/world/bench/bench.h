// A bench is the setup that a user describes in one file (docs/bench.md). It is checked when it is created,
// so code that uses it can rely on all names.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file_claims.h"
#include "base/simulated_time.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/inline_text.h"
#include "emulator/world/bench/listening.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/plant/plant.h"
#include "pty/line.h"

namespace understudy::emulator::world {

/// A device on a line, connected through one of its ports.
struct StationSetup {
  StationSetup(std::size_t device_number, std::size_t port_number = 0)  // NOLINT(*-explicit-*): most have one
      : device(device_number), port(port_number) {}
  std::size_t device;
  std::size_t port;
  bool operator==(const StationSetup&) const = default;
};

/// How long a line by default waits for the rest of a frame. Hosts wait at least this long for a reply.
inline constexpr SimTime kUsualByteTimeout = std::chrono::milliseconds(200);
inline constexpr SimTime kShortestByteTimeout = std::chrono::milliseconds(10);
inline constexpr SimTime kLongestByteTimeout = std::chrono::minutes(1);
inline constexpr std::string_view kByteTimeoutExpected = "expected 10ms to 60s, as in 200ms";

struct LineSetup {
  std::string name;
  std::string link;               // path of the link to the pty; empty: none
  bool has_pty = true;            // false: hosts connect only over TCP
  std::vector<TcpAddress> tcp{};  // additional TCP addresses at which it listens
  int baud = 0;                   // 0: the first station's factory speed
  pty::Timing timing = pty::Timing::wire;
  bool echoes = false;                                            // hosts receive their own bytes
  std::int64_t baud_tolerance_ppm = pty::kUsualBaudTolerancePpm;  // how far a host's speed may differ
  SimTime byte_timeout = kUsualByteTimeout;  // for the rest of a frame, measured with the host's clock
  std::vector<StationSetup> stations;        // in the order of the file
};

struct DeviceSetup {
  const Model* model = nullptr;
  DeviceSettings settings;
  std::string nv_path{};                       // the file of the non-volatile memory; empty: none
  std::optional<InlineText> program_inside{};  // the place of a program that is in the bench file
};

struct MachineSetup {
  std::size_t device = 0;
  int axis = 0;
  PlantSetup plant;
};

/// A wire between terminals, given by number: from an output of a device, or a contact of a machine, to an
/// input of another device or of a drive.
struct WireSetup {
  std::size_t from_device = 0;
  int from_terminal = 0;
  int from_axis = -1;  // if not -1, the wire begins at a contact of this axis's machine
  Contact from_contact = Contact::home;
  std::size_t to_device = 0;
  int to_terminal = 0;
  int to_axis = -1;  // if not -1, the wire ends at an input of this axis's drive
  DriveInput to_input = DriveInput::servo;
};

/// The level of an input when the world begins, in the terminal's unit.
struct InputSetup {
  std::size_t device = 0;
  int terminal = 0;
  std::int32_t level = 0;
};

struct Bench {
  std::vector<LineSetup> lines;
  std::vector<DeviceSetup> devices;
  std::vector<MachineSetup> machines;
  std::vector<WireSetup> wires;
  std::vector<InputSetup> inputs;
  std::vector<Fault> faults;       // the initial faults
  std::uint64_t seed = 0;          // the seed of the random numbers
  std::vector<FileClaim> files{};  // all files from which it was read, except memory files
};

/// The names of both ends of a wire: "feeder.DOUT_4", "feeder.A.home", "feeder.A.alarm_clear".
struct WireEnds {
  std::string from;
  std::string to;
};
WireEnds ends_of(const WireSetup& wire, const KnownDevices& known);

/// Returns the devices by name, including their lines.
KnownDevices known_devices_of(const Bench& bench);

/// Returns a bench with one device, which has a line for each of its ports. If there is only one port, the
/// line is called "line"; otherwise, the lines are named after the ports. `link` is the link of the first
/// line; to the other links, the name of the port is appended.
Bench bench_of_one(const Model& model, DeviceSettings settings, const std::string& link);

/// Parses "200ms". Returns nothing if the text is not a valid timeout.
std::optional<SimTime> parse_byte_timeout(std::string_view text);

/// Converts "2%" or "0.5%" (0% to 10%) to millionths. Returns nothing if the text is not a valid tolerance.
std::optional<std::int64_t> parse_baud_tolerance(std::string_view text);
inline constexpr std::string_view kBaudToleranceExpected = "expected 0% to 10%, as in 2%";

/// Returns the input to which a contact of an axis's machine is connected, or -1 if it is not connected.
int input_of(const AxisRow& axis, const PlantAxis& machine, Contact contact);

}  // namespace understudy::emulator::world
