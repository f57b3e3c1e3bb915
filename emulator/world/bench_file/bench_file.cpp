#include "emulator/world/bench_file/bench_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_names.h"
#include "emulator/world/bench_file/bench_schema.h"
#include "emulator/world/bench_file/device_fields.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/disturbance_fields.h"
#include "emulator/world/bench_file/keys.h"
#include "emulator/world/bench_file/line_fields.h"
#include "emulator/world/bench_file/machine_fields.h"
#include "emulator/world/bench_file/station_fields.h"
#include "emulator/world/bench_file/wire_fields.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/names/names.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/view/bench_inventory.h"

namespace understudy::emulator::world {

namespace {

constexpr std::string_view kTime = "time";  // reserved for conditions

class BenchReader {
 public:
  /// Paths are relative to `folder`; links are relative to `links`, or by default also to `folder`. Without a
  /// folder, paths are refused.
  explicit BenchReader(ModelList models, std::optional<std::string> folder, const std::string& links = "")
      : models_(models), folder_(std::move(folder)), links_(links.empty() ? folder_ : links) {}

  BenchReader(const BenchReader&) = delete;
  BenchReader& operator=(const BenchReader&) = delete;

  /// Reads the bench. Throws all diagnostics, including those passed as an argument.
  Bench read(const YamlFields& root, Diagnostics diagnostics) {
    all_ = std::move(diagnostics);
    all_.require([&] { read_all(root); });
    return std::move(bench_);
  }

 private:
  void read_all(const YamlFields& root) {
    const auto read_part = [&](const char* key, const auto& read) {
      all_.attempt([&] {
        if (const auto field = root.find(key)) read(*field);
      });
    };
    read_part("devices", [&](const YamlFields& devices) { read_devices(devices); });
    all_.attempt([&] { read_lines(root.at("lines")); });
    read_part("plant", [&](const YamlFields& plant) { read_plant(plant); });
    read_part("wires", [&](const YamlFields& wires) { read_wires(wires); });
    read_part("seed", [&](const YamlFields& seed) {
      bench_.seed = static_cast<std::uint64_t>(seed.integer(kSeedSchema));
    });
    give_usual_addresses();
    check_devices();
    check_addresses(numbered_, bench_, all_);
    read_disturbances(root);
  }

  // --- devices -------------------------------------------------------------------------------
  void read_devices(const YamlFields& devices) {
    devices.require_map();
    for (const auto& [name, fields] : devices.entries()) {
      all_.attempt([&, &keys = fields] { keys.require_keys(kDeviceKeys); });
      all_.attempt([&, &called = name, &keys = fields] { require_new_name(keys, called); });
      all_.attempt([&, &called = name, &keys = fields] { add_device(called, keys); });
    }
  }

  /// Adds a device even if its name is wrong, so that its other properties can be checked.
  std::size_t add_device(const std::string& name, const YamlFields& fields) {
    if (!name.empty()) names_.lose_device(name);
    DeviceSetup device = read_device(fields, name, folder_, models_, bench_, all_);
    if (device.model == nullptr) throw AlreadyReported();
    bench_.devices.push_back(std::move(device));
    names_.find_device_again(name);
    const std::size_t ports = bench_.devices.back().model->line.ports.size();
    places_.push_back({.device = fields});
    places_.back().stations.resize(ports);
    bench_.devices.back().settings.bauds.resize(ports);
    return bench_.devices.size() - 1;
  }

  void require_new_name(const YamlFields& field, const std::string& name) const {
    require_name(field, name);
    if (name == kTime) field.fail("means simulated time in conditions; expected another name");
    if (names_.find_device(name) >= 0)
      field.fail("two devices are called " + understudy::quoted(name) + "; expected a different name");
  }

  // --- lines ---------------------------------------------------------------------------------
  void read_lines(const YamlFields& lines) {
    lines.require_map();
    if (lines.entries().empty()) lines.fail("has no lines; expected at least one");
    for (const auto& [name, fields] : lines.entries()) {
      all_.attempt([&, &called = name, &keys = fields] {
        const std::size_t before = all_.count();
        names_.lose_part(called);
        read_line(called, keys);
        if (all_.count() == before) names_.find_part_again(called);
      });
    }
  }

  void read_line(const std::string& name, const YamlFields& fields) {
    const Keys keys(fields, kLineKeys, all_);
    all_.attempt([&] { require_name(fields, name); });
    LineSetup line{.name = name, .link = {}, .stations = {}};
    read_ports_of(keys, line);
    std::vector<NumberedStation>& numbered = numbered_.emplace_back();
    keys.require("stations", [&](const YamlFields& stations) {
      if (stations.elements().empty()) stations.fail("is empty; expected at least one station");
      for (const YamlFields& station : stations.elements()) {
        all_.attempt([&] { read_station(station, line, numbered); });
      }
    });
    all_.attempt([&] { require_ports(fields, line, bench_); });
    bench_.lines.push_back(std::move(line));
  }

  /// Reads the ports, the speed and the timing of a line.
  void read_ports_of(const Keys& keys, LineSetup& line) {
    keys.read("link", [&](const YamlFields& field) { line.link = read_link(field, links_, bench_.lines); });
    keys.read("listen", [&](const YamlFields& field) { read_listen(field, bench_.lines, line, all_); });
    keys.read("pty", [&](const YamlFields& field) { line.has_pty = field.on_or_off(); });
    keys.read("baud",
              [&](const YamlFields& field) { line.baud = static_cast<int>(field.integer(kBaudSchema)); });
    keys.read("echo", [&](const YamlFields& field) { line.echoes = read_echo(field); });
    keys.read("byte_timeout", [&](const YamlFields& field) { line.byte_timeout = read_byte_timeout(field); });
    keys.read("baud_tolerance",
              [&](const YamlFields& field) { line.baud_tolerance_ppm = read_baud_tolerance(field); });
    keys.read("timing", [&](const YamlFields& field) { line.timing = read_timing(field); });
  }

  void read_station(const YamlFields& station, LineSetup& line, std::vector<NumberedStation>& numbered) {
    if (!station.is_map()) station.fail("expected a map, as in `key: value`");
    std::size_t device = 0;
    const bool is_placed = station.has("device");
    const bool is_known = all_.attempt([&] {
      if (is_placed) {
        device = names_.require_device(station.at("device"), station.at("device").text());
      } else {
        std::string name;
        all_.attempt([&] {
          name = station.at("name").text();
          require_new_name(station.at("name"), name);
        });
        device = add_device(name, station);
      }
    });
    all_.attempt([&] {
      if (is_placed) return station.require_keys(kPlacedStationKeys);
      station.require_keys(kStationKeys);
    });
    if (!is_known) {
      const auto address = station.find("address");
      if (!address) return;
      const int number = static_cast<int>(address->integer(kAddressSchema));
      if (!is_placed) numbered.push_back({station, std::nullopt, number});
      return;
    }
    DeviceSetup& setup = bench_.devices[device];
    const bool is_here =
        std::ranges::find(line.stations, device, &StationSetup::device) != line.stations.end();
    all_.attempt([&] {
      const std::size_t port = take_port(station, device, line);
      setup.settings.bauds[port] = line.baud;
      require_room(station, {device, port}, line, bench_);
      line.stations.emplace_back(device, port);
    });
    const auto address = read_address(station, setup);
    if (!is_here) numbered.push_back({station, device, address});
  }

  /// Returns the port in a station's entry. The port must not already be on another line, and the device must
  /// not already be on this line.
  std::size_t take_port(const YamlFields& station, std::size_t device, const LineSetup& line) {
    const Model& model = names_.model_of(device);
    const std::size_t port = read_port(station, model);
    const auto name_of = [&](std::size_t number) { return std::string(model.line.ports[number].name); };
    auto& stations = places_[device].stations;
    if (stations[port] && stations.size() == 1)
      station.fail("the device is already on a line; expected it on only one line");
    if (stations[port])
      station.fail("the device's port " + name_of(port) +
                   " is already on a line; expected another `port`, or the device on one line");
    stations[port] = station;
    for (const auto& [other, other_port] : line.stations) {
      if (other != device) continue;
      station.fail("the device is already on this line, with its port " + name_of(other_port) +
                   "; expected another line");
    }
    return port;
  }

  /// Assigns address 1 to devices whose address is set neither by the bench nor by a register.
  void give_usual_addresses() {
    for (DeviceSetup& device : bench_.devices) {
      const auto& numbers = device.model->line.station_numbers;
      if (numbers && numbers->kept_in.empty() && !device.settings.address) device.settings.address = 1;
    }
  }

  // --- plant and wires -------------------------------------------------------------------------
  void read_plant(const YamlFields& plant) {
    plant.require_map();
    for (const auto& [name, fields] : plant.entries()) {
      all_.attempt([&, &called = name, &machine = fields] { read_machine_of(called, machine); });
    }
    require_own_inputs(plant);
  }

  void read_machine_of(const std::string& name, const YamlFields& fields) {
    MachineSetup machine{.device = 0, .axis = 0, .plant = {}};
    const Model* model = nullptr;
    const std::size_t before = all_.count();
    const bool is_known = all_.attempt([&] {
      const auto [device, axis_name] = names_.split(fields, name, "feeder.A");
      model = bench_.devices[device].model;
      machine.device = device;
      machine.axis = require_axis(fields, *model, axis_name);
    });
    const AxisRow* const axis = is_known ? &model->axes[static_cast<std::size_t>(machine.axis)] : nullptr;
    machine.plant = read_machine(fields, model, axis, all_);
    if (is_known) bench_.machines.push_back(machine);
    if (all_.count() != before) names_.lose_part(name);
  }

  /// Checks that no two contacts are connected to the same input, because the bench can connect a switch to
  /// any input.
  void require_own_inputs(const YamlFields& plant) const {
    std::map<std::pair<std::size_t, int>, std::string> taken;
    for (const MachineSetup& machine : bench_.machines) {
      const DeviceSetup& device = bench_.devices[machine.device];
      const AxisRow& axis = device.model->axes[static_cast<std::size_t>(machine.axis)];
      const std::string name = device.settings.name + "." + std::string(axis.name);
      for (std::size_t i = 0; i < kContactNames.size(); ++i) {
        const int input = input_of(axis, PlantAxis(machine.plant), static_cast<Contact>(i));
        if (input < 0) continue;
        const std::string contact = name + "." + std::string(kContactNames[i]);
        const auto [other, is_free] = taken.emplace(std::pair(machine.device, input), contact);
        if (is_free || names_.is_lost_part(name)) continue;
        plant.at(name).fail(contact + " and " + other->second + " are both wired to " +
                            std::string(device.model->terminals[static_cast<std::size_t>(input)].name) +
                            "; expected one contact on an input, and `wires` for more");
      }
    }
  }

  void read_wires(const YamlFields& wires) {
    for (const YamlFields& wire : wires.elements()) {
      all_.attempt([&] { bench_.wires.push_back(read_wire(wire, bench_, names_, all_)); });
    }
  }

  // --- checks that need the model ----------------------------------------------------------------
  void check_devices() {
    // A station that could not be read may refer to the device.
    const bool has_all_lines = all_.count() == 0;
    for (std::size_t i = 0; i < bench_.devices.size(); ++i) {
      all_.attempt([&] {
        const auto& stations = places_[i].stations;
        const bool is_on_a_line = std::any_of(stations.begin(), stations.end(),
                                              [](const auto& station) { return station.has_value(); });
        if (!is_on_a_line && has_all_lines)
          places_[i].device.fail("the device is not on a line; expected a station that names it");
      });
      judge_device(places_[i], bench_.devices[i], all_);
    }
  }

  // --- disturbances from the beginning ------------------------------------------------------------
  void read_disturbances(const YamlFields& root) {
    const KnownDevices known = known_devices_of(bench_);
    all_.attempt([&] {
      if (!root.has("inputs")) return;
      all_.attempt([&] { root.at("inputs").require_map(); });
      for (const auto& [name, level] : root.at("inputs").entries()) {
        all_.attempt([&, &called = name, &field = level] {
          if (names_.names_lost(called)) throw AlreadyReported();
          bench_.inputs.push_back(read_input(field, called, known));
        });
      }
    });
    all_.attempt([&] {
      if (root.has("faults")) read_faults(root.at("faults").elements(), known);
    });
  }

  /// Reads all faults, then checks whether the bench can have them.
  void read_faults(const std::vector<YamlFields>& elements, const KnownDevices& known) {
    std::vector<std::pair<YamlFields, std::optional<Fault>>> faults;
    for (const YamlFields& element : elements) {
      if (names_.has_lost(element)) continue;
      faults.emplace_back(element, read_fault(element, known, all_));
      if (faults.back().second) bench_.faults.push_back(*faults.back().second);
    }
    const BenchInventory inventory(bench_);
    for (const auto& [fields, fault] : faults) require_possible(fields, inventory, fault, all_);
  }

  ModelList models_;
  std::optional<std::string> folder_;
  std::optional<std::string> links_;
  Diagnostics all_;
  Bench bench_;
  BenchNames names_{bench_};
  std::vector<DevicePlaces> places_;                    // for each device
  std::vector<std::vector<NumberedStation>> numbered_;  // for each line
};

Bench read_whole(const std::string& text, const std::string& name, BenchReader reader) {
  const YamlFields root = YamlFields::parse(text, name, "bench", "`understudy: 1` and `lines:`");
  if (!root.has("lines") && (root.has("steps") || root.has("bench"))) {
    throw FileError({name, 1, 1}, "bench: is a scenario; expected a bench (`understudy run` runs scenarios)");
  }
  if (!root.has("lines") && (root.has("registers") || root.has("model"))) {
    throw FileError({name, 1, 1}, "bench: is a model file; expected a bench, whose stations name it");
  }
  Diagnostics diagnostics;
  diagnostics.attempt([&] { root.require_keys(kBenchKeys); });
  diagnostics.attempt([&] { root.at("understudy").integer(kVersionSchema); });
  return reader.read(root, std::move(diagnostics));
}

}  // namespace

Bench parse_bench(ModelList models, const std::string& text, const std::string& name,
                  const std::string& folder, const std::string& links) {
  return read_whole(text, name, BenchReader(models, folder, links));
}

Bench parse_recorded_bench(ModelList models, const std::string& text) {
  return read_whole(text, "bench", BenchReader(models, std::nullopt));
}

Bench read_bench(ModelList models, const YamlFields& fields, const std::string& folder) {
  Diagnostics diagnostics;
  diagnostics.attempt([&] { fields.require_keys(kInlineBenchKeys); });
  return BenchReader(models, folder).read(fields, std::move(diagnostics));
}

namespace {

Bench bench_of(ModelList models, const std::string& text, const std::string& path, const std::string& links) {
  Bench bench = parse_bench(models, text, path, std::filesystem::path(path).parent_path().string(), links);
  bench.files.insert(bench.files.begin(), {path, "the bench itself"});
  return bench;
}

}  // namespace

Bench load_bench(ModelList models, const std::string& path, const std::string& links) {
  const auto text = read_text_file(path);
  if (!text) throw FileError(path + ": bench: " + text.why + "; expected a bench file");
  return bench_of(models, *text, path, links);
}

Bench load_bench(ModelList models, const YamlFields& path) {
  const auto text = read_text_file(path.path());
  if (!text) path.fail(path.path() + " " + text.why + "; expected a bench file");
  if (const std::string why = is_another_kind(*text, ContentKind::bench); !why.empty())
    path.fail(path.path() + " " + why);
  return bench_of(models, *text, path.path(), "");
}

}  // namespace understudy::emulator::world
