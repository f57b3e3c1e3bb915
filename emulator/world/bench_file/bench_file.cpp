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

#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_form.h"
#include "emulator/world/bench_file/bench_names.h"
#include "emulator/world/bench_file/device_fields.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/disturbance_fields.h"
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

constexpr std::string_view kTime = "time";  // conditions already use this name

class BenchReader {
 public:
  /// Paths are relative to `folder`; links are relative to `links` if it is given. Paths are refused if there
  /// is no folder.
  explicit BenchReader(ModelList models, std::optional<std::string> folder, const std::string& links = "")
      : models_(models), folder_(std::move(folder)), links_(links.empty() ? folder_ : links) {}

  BenchReader(const BenchReader&) = delete;
  BenchReader& operator=(const BenchReader&) = delete;

  /// Reads the bench. Throws all diagnostics, including those that are passed in.
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
      all_.attempt([&, &called = name, &keys = fields] { add_device(keys, called, keys); });
    }
  }

  std::size_t add_device(const YamlFields& name_field, const std::string& name, const YamlFields& fields) {
    require_name(name_field, name);
    if (name == kTime) name_field.fail("is the name of the time in conditions; expected another name");
    if (names_.find_device(name) >= 0)
      name_field.fail("two devices are called " + understudy::quoted(name) + "; expected a new name");
    names_.lose_device(name);
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

  // --- lines ---------------------------------------------------------------------------------
  void read_lines(const YamlFields& lines) {
    lines.require_map();
    if (lines.entries().empty()) lines.fail("has no line; expected at least one");
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
    all_.attempt([&] { fields.require_keys(kLineKeys); });
    all_.attempt([&] { require_name(fields, name); });
    LineSetup line{.name = name, .link = {}, .stations = {}};
    all_.attempt([&] {
      if (const auto link = fields.find("link")) line.link = read_link(*link, links_, bench_.lines);
    });
    all_.attempt([&] {
      if (const auto listen = fields.find("listen")) line.tcp = read_listen(*listen, bench_.lines);
    });
    all_.attempt([&] {
      if (const auto pty = fields.find("pty")) line.has_pty = pty->on_or_off();
    });
    all_.attempt([&] {
      if (const auto baud = fields.find("baud")) line.baud = static_cast<int>(baud->integer(kBaudSchema));
    });
    all_.attempt([&] {
      if (const auto echo = fields.find("echo")) line.echoes = read_echo(*echo);
      if (const auto timeout = fields.find("byte_timeout")) line.byte_timeout = read_byte_timeout(*timeout);
      if (const auto tolerance = fields.find("baud_tolerance")) {
        line.baud_tolerance_ppm = read_baud_tolerance(*tolerance);
      }
    });
    all_.attempt([&] {
      if (const auto timing = fields.find("timing")) line.timing = read_timing(*timing);
    });
    std::vector<NumberedStation>& numbered = numbered_.emplace_back();
    const auto stations = fields.at("stations").elements();
    if (stations.empty()) fields.at("stations").fail("is empty; expected at least one station");
    for (const YamlFields& station : stations) {
      all_.attempt([&] { read_station(station, line, numbered); });
    }
    all_.attempt([&] { require_ports(fields, line, bench_); });
    bench_.lines.push_back(std::move(line));
  }

  void read_station(const YamlFields& station, LineSetup& line, std::vector<NumberedStation>& numbered) {
    if (!station.is_map()) station.fail("expected a map, as in `key: value`");
    std::size_t device = 0;
    if (station.has("device")) {
      all_.attempt([&] { station.require_keys(kPlacedStationKeys); });
      device = names_.require_device(station.at("device"), station.at("device").text());
    } else {
      all_.attempt([&] { station.require_keys(kStationKeys); });
      const bool is_known =
          all_.attempt([&] { device = add_device(station.at("name"), station.at("name").text(), station); });
      if (!is_known) {
        const auto address = station.find("address");
        if (address)
          numbered.push_back({station, std::nullopt, static_cast<int>(address->integer(kAddressSchema))});
        throw AlreadyReported();
      }
    }
    DeviceSetup& setup = bench_.devices[device];
    const std::size_t port = take_port(station, device, line);
    setup.settings.bauds[port] = line.baud;
    require_room(station, {device, port}, line, bench_);
    numbered.push_back({station, device, read_address(station, setup)});
    line.stations.emplace_back(device, port);
  }

  /// Returns the port that a station names. The port must not be on another line, and the device must not be
  /// on this line with another port.
  std::size_t take_port(const YamlFields& station, std::size_t device, const LineSetup& line) {
    const Model& model = names_.model_of(device);
    const std::size_t port = read_port(station, model);
    const auto name_of = [&](std::size_t number) { return std::string(model.line.ports[number].name); };
    auto& stations = places_[device].stations;
    if (stations[port] && stations.size() == 1)
      station.fail("the device is already on a line; expected it on one line");
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

  /// Gives address 1 to devices whose address neither the bench nor a register sets.
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
    const auto [device, axis_name] = names_.split(fields, name, "feeder.A");
    const Model& model = *bench_.devices[device].model;
    const int axis = find_axis(model, axis_name);
    if (axis < 0) {
      std::string axes;
      for (const AxisRow& row : model.axes) axes += (axes.empty() ? "" : ", ") + std::string(row.name);
      fields.fail(understudy::quoted(axis_name) + " is not an axis of " + std::string(model.name) +
                  "; expected one of " + axes);
    }
    const std::size_t before = all_.count();
    bench_.machines.push_back(
        {.device = device, .axis = axis, .plant = read_machine(fields, model, axis, all_)});
    if (all_.count() != before) names_.lose_part(name);
  }

  /// Checks that no two contacts share an input: a switch that the bench moves to another input may meet one.
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
      all_.attempt([&] { bench_.wires.push_back(read_wire(wire, bench_, names_)); });
    }
  }

  // --- checks that need the model ----------------------------------------------------------------
  void check_devices() {
    // A station that could not be read may have named the device.
    const bool has_all_lines = all_.count() == 0;
    for (std::size_t i = 0; i < bench_.devices.size(); ++i) {
      all_.attempt([&] {
        const auto& stations = places_[i].stations;
        const bool is_on_a_line = std::any_of(stations.begin(), stations.end(),
                                              [](const auto& station) { return station.has_value(); });
        if (!is_on_a_line && has_all_lines)
          places_[i].device.fail("the device is on no line; expected a station that names it");
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

  /// Reads the faults first and checks their conditions afterwards, when the names of all faults are known.
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
    throw FileError({name, 1, 1},
                    "bench: is a scenario; expected a bench (`understudy run` plays scenarios)");
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
  return bench_of(models, *text, path.path(), "");
}

}  // namespace understudy::emulator::world
