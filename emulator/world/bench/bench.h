// A bench is the setup that a user describes in one file (docs/bench.md). It is checked when it is made, so
// code that uses it can rely on every name.
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

/// A device on a line, connected by one of its ports.
struct StationSetup {
  StationSetup(std::size_t device_number, std::size_t port_number = 0)  // NOLINT(*-explicit-*): most have one
      : device(device_number), port(port_number) {}
  std::size_t device;
  std::size_t port;
  bool operator==(const StationSetup&) const = default;
};

/// How long a line waits for the rest of a frame by default. Hosts wait at least as long for a reply.
inline constexpr SimTime kUsualByteTimeout = std::chrono::milliseconds(200);
inline constexpr SimTime kShortestByteTimeout = std::chrono::milliseconds(10);
inline constexpr SimTime kLongestByteTimeout = std::chrono::minutes(1);
inline constexpr std::string_view kByteTimeoutExpected = "expected 10ms to 60s, as in 200ms";

struct LineSetup {
  std::string name;
  std::string link;               // path of the link to its pty; empty: none
  bool has_pty = true;            // otherwise hosts connect only over TCP
  std::vector<TcpAddress> tcp{};  // TCP addresses at which it also listens
  int baud = 0;                   // 0: the first station's factory speed
  pty::Timing timing = pty::Timing::wire;
  bool echoes = false;                                            // hosts receive their own bytes
  std::int64_t baud_tolerance_ppm = pty::kUsualBaudTolerancePpm;  // how much a host's speed may differ
  SimTime byte_timeout = kUsualByteTimeout;  // for the rest of a frame, by the host's clock
  std::vector<StationSetup> stations;        // in the order written
};

struct DeviceSetup {
  const Model* model = nullptr;
  DeviceSettings settings;
  std::string nv_path{};                       // the file of its non-volatile memory; empty: none
  std::optional<InlineText> program_inside{};  // the place of a program within the bench file
};

struct MachineSetup {
  std::size_t device = 0;
  int axis = 0;
  PlantSetup plant;
};

/// A wire from an output of one device, or from a contact of a machine, to an input of another device or of
/// a drive, by terminal numbers.
struct WireSetup {
  std::size_t from_device = 0;
  int from_terminal = 0;
  int from_axis = -1;  // if not -1, the source is a contact of this axis's machine
  Contact from_contact = Contact::home;
  std::size_t to_device = 0;
  int to_terminal = 0;
  int to_axis = -1;  // if not -1, the destination is an input of this axis's drive
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
  std::vector<Fault> faults;       // the initial ones
  std::uint64_t seed = 0;          // the seed of the random numbers
  std::vector<FileClaim> files{};  // all files that it was read from, except memory files
};

/// The names of both ends of a wire: "feeder.DOUT_4", "feeder.A.home", "feeder.A.alarm_clear".
struct WireEnds {
  std::string from;
  std::string to;
};
WireEnds ends_of(const WireSetup& wire, const KnownDevices& known);

/// Returns the devices by name, with their lines.
KnownDevices known_devices_of(const Bench& bench);

/// Returns a bench of one device, with a line for each of its ports. The line of a device with one port is
/// called "line"; several lines are named after the ports. `link` is the link of the first; the others add
/// the port's name.
Bench bench_of_one(const Model& model, DeviceSettings settings, const std::string& link);

/// Parses "200ms". Returns nothing if the text is not a valid timeout.
std::optional<SimTime> parse_byte_timeout(std::string_view text);

/// Parses "2%" or "0.5%", from 0% to 10%, into millionths. Returns nothing if the text is not a valid
/// tolerance.
std::optional<std::int64_t> parse_baud_tolerance(std::string_view text);
inline constexpr std::string_view kBaudToleranceExpected = "expected 0% to 10%, as in 2%";

/// Returns the input to which a contact of an axis's machine is wired, or -1 if it is not wired.
int input_of(const AxisRow& axis, const PlantAxis& machine, Contact contact);

}  // namespace understudy::emulator::world
