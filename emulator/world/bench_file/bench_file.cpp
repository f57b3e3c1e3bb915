#include "emulator/world/bench_file/bench_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <tuple>

#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/device.h"
#include "emulator/world/bench_file/bench_form.h"
#include "emulator/world/bench_file/complaints.h"
#include "emulator/world/bench_file/device_fields.h"
#include "emulator/world/bench_file/disturbance_fields.h"
#include "emulator/world/bench_file/machine_fields.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/names/names.h"
#include "emulator/world/speech/line_speech.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

namespace {

constexpr std::string_view kTime = "time";     // a name in conditions already
constexpr std::size_t kLongestLinkName = 200;  // a link has a lock beside it

class BenchReader {
 public:
  /// Paths are relative to `folder`, links to `links`, if that is given. Without a folder paths are refused.
  explicit BenchReader(ModelList models, std::optional<std::string> folder, const std::string& links = "")
      : models_(models), folder_(std::move(folder)), links_(links.empty() ? folder_ : links) {}

  /// Throws all that is wrong, with what was wrong before.
  Bench read(const YamlFields& root, Complaints complaints) {
    all_ = std::move(complaints);
    all_.demand([&] { read_all(root); });
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
      bench_.seed = static_cast<std::uint64_t>(seed.integer(kSeedForm));
    });
    check_devices();
    read_disturbances(root);
  }

  // --- devices -------------------------------------------------------------------------------
  void read_devices(const YamlFields& devices) {
    devices.demand_map();
    for (const auto& [name, fields] : devices.entries()) {
      all_.attempt([&, &keys = fields] { keys.demand_keys(kDeviceKeys); });
      all_.attempt([&, &called = name, &keys = fields] { add_device(keys, called, keys); });
    }
  }

  std::size_t add_device(const YamlFields& name_field, const std::string& name, const YamlFields& fields) {
    demand_name(name_field, name);
    if (name == kTime) name_field.fail("is what conditions call the time; expected another name");
    if (find_device(name) >= 0)
      name_field.fail("two devices are called " + understudy::quoted(name) + "; expected a new name");
    unknown_.insert(name);
    DeviceSetup device = read_device(fields, name, folder_, models_, bench_, all_);
    if (device.model == nullptr) throw Untold();
    bench_.devices.push_back(std::move(device));
    unknown_.erase(name);
    device_fields_.push_back(fields);
    on_a_line_.push_back(false);
    return bench_.devices.size() - 1;
  }

  int find_device(const std::string& name) const {
    for (std::size_t i = 0; i < bench_.devices.size(); ++i) {
      if (bench_.devices[i].settings.name == name) return static_cast<int>(i);
    }
    return -1;
  }

  std::size_t demand_device(const YamlFields& field, const std::string& name) const {
    const int found = find_device(name);
    if (found >= 0) return static_cast<std::size_t>(found);
    if (unknown_.contains(name)) throw Untold();
    std::vector<std::string> names;
    for (const DeviceSetup& device : bench_.devices) names.push_back(device.settings.name);
    field.fail("no device is called " + understudy::quoted(name) + suggestion(name, names));
  }

  // --- lines ---------------------------------------------------------------------------------
  void read_lines(const YamlFields& lines) {
    lines.demand_map();
    if (lines.entries().empty()) lines.fail("has no line; expected at least one");
    for (const auto& [name, fields] : lines.entries()) {
      all_.attempt([&, &called = name, &keys = fields] {
        const std::size_t before = all_.count();
        unread_.insert(called);
        read_line(called, keys);
        if (all_.count() == before) unread_.erase(called);
      });
    }
  }

  void read_line(const std::string& name, const YamlFields& fields) {
    all_.attempt([&] { fields.demand_keys(kLineKeys); });
    all_.attempt([&] { demand_name(fields, name); });
    LineSetup line{.name = name, .link = {}, .stations = {}};
    all_.attempt([&] {
      if (const auto link = fields.find("link")) read_link(*link, line);
    });
    all_.attempt([&] {
      if (const auto baud = fields.find("baud")) line.baud = static_cast<int>(baud->integer(kBaudForm));
    });
    all_.attempt([&] {
      if (const auto tolerance = fields.find("baud_tolerance")) {
        line.baud_tolerance_ppm = read_baud_tolerance(*tolerance);
      }
    });
    all_.attempt([&] {
      if (const auto timing = fields.find("timing")) line.timing = read_timing(*timing);
    });
    std::set<std::int64_t> addresses;
    const auto stations = fields.at("stations").elements();
    if (stations.empty()) fields.at("stations").fail("is empty; expected at least one station");
    for (const YamlFields& station : stations) {
      all_.attempt([&] { read_station(station, line, addresses); });
    }
    bench_.lines.push_back(std::move(line));
  }

  static pty::Timing read_timing(const YamlFields& timing) {
    if (timing.text() != "wire" && timing.text() != "instant") {
      timing.fail(understudy::quoted(timing.text()) + " is not a timing; expected wire or instant");
    }
    return timing.text() == "wire" ? pty::Timing::wire : pty::Timing::instant;
  }

  static std::int64_t read_baud_tolerance(const YamlFields& tolerance) {
    if (const auto ppm = parse_baud_tolerance(tolerance.text())) return *ppm;
    tolerance.fail(understudy::quoted(tolerance.text()) + " is not a share of the speed; " +
                   std::string(kBaudToleranceExpected));
  }

  void read_link(const YamlFields& link, LineSetup& line) const {
    namespace fs = std::filesystem;
    const std::string written = link.text();
    if (written.find("://") != std::string::npos)
      link.fail(understudy::quoted(written) +
                " is an address of a network; expected a path, for a serial port");
    line.link = path_in(links_, link);
    if (one_line(line.link) != line.link) link.fail("has a control character; expected a path without");
    const std::string name = fs::path(line.link).filename().string();
    if (name.size() > kLongestLinkName) {
      link.fail("has a name of " + std::to_string(name.size()) + " characters; expected at most " +
                std::to_string(kLongestLinkName));
    }
    std::error_code ignored;
    const fs::file_type there = fs::symlink_status(line.link, ignored).type();
    if (name.empty() || name == "." || name == ".." || there == fs::file_type::directory)
      link.fail(understudy::quoted(written) + " is a folder; expected a path for the link in it");
    if (there == fs::file_type::character || there == fs::file_type::block)
      link.fail(understudy::quoted(written) + " is a device of this machine; expected a path that is free");
    const auto absolute = [](const std::string& path) { return fs::weakly_canonical(fs::absolute(path)); };
    for (const LineSetup& other : bench_.lines) {
      if (!other.link.empty() && absolute(other.link) == absolute(line.link))
        link.fail("line " + understudy::quoted(other.name) + " has the same link; expected another path");
    }
  }

  void read_station(const YamlFields& station, LineSetup& line, std::set<std::int64_t>& addresses) {
    if (!station.is_map()) station.fail("expected a map, as in `key: value`");
    std::size_t device = 0;
    if (station.has("device")) {
      all_.attempt([&] { station.demand_keys(kPlacedStationKeys); });
      device = demand_device(station.at("device"), station.at("device").text());
    } else {
      all_.attempt([&] { station.demand_keys(kStationKeys); });
      const bool is_known =
          all_.attempt([&] { device = add_device(station.at("name"), station.at("name").text(), station); });
      if (!is_known) {
        if (station.has("address"))
          take_address(station, kAddressForm.lowest, kAddressForm.highest, addresses);
        throw Untold();
      }
    }
    if (on_a_line_[device]) station.fail("the device is on a line already; expected it on one line");
    on_a_line_[device] = true;
    DeviceSetup& setup = bench_.devices[device];
    setup.settings.baud = line.baud;
    const auto is_alone = [&](std::size_t other) {
      return !bench_.devices[other].model->line.station_numbers.has_value();
    };
    if (!line.stations.empty() && (is_alone(device) || is_alone(line.stations.front()))) {
      const DeviceSetup& speaker = bench_.devices[is_alone(device) ? device : line.stations.front()];
      station.fail(understudy::quoted(speaker.settings.name) + " speaks " +
                   std::string(speaker.model->line.protocol.name) +
                   " and must be alone on its line; expected no other station on it");
    }
    if (const auto& numbers = setup.model->line.station_numbers) {
      setup.settings.address = take_address(station, numbers->lowest, numbers->highest, addresses);
    } else if (station.has("address")) {
      station.at("address").fail(std::string(setup.model->name) + " has no station number; expected none");
    }
    device_fields_[device] = station.has("device") ? device_fields_[device] : station;
    line.stations.push_back(device);
  }

  static int take_address(const YamlFields& station, std::int64_t lowest, std::int64_t highest,
                          std::set<std::int64_t>& addresses) {
    const std::int64_t address = station.has("address") ? station.at("address").integer(lowest, highest) : 1;
    if (!addresses.insert(address).second) {
      station.fail("address " + std::to_string(address) + " is taken on this line; expected another");
    }
    return static_cast<int>(address);
  }

  // --- plant and wires -------------------------------------------------------------------------
  /// "feeder.A" into the device and what is behind the dot.
  std::pair<std::size_t, std::string> split(const YamlFields& field, const std::string& name,
                                            const char* example) const {
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos)
      field.fail(understudy::quoted(name) + " names no device; expected a name like " + example);
    return {demand_device(field, name.substr(0, dot)), name.substr(dot + 1)};
  }

  void read_plant(const YamlFields& plant) {
    plant.demand_map();
    for (const auto& [name, fields] : plant.entries()) {
      all_.attempt([&, &called = name, &machine = fields] { read_machine_of(called, machine); });
    }
    demand_own_inputs(plant);
  }

  void read_machine_of(const std::string& name, const YamlFields& fields) {
    const auto [device, axis_name] = split(fields, name, "feeder.A");
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
    if (all_.count() != before) unread_.insert(name);
  }

  /// A switch that is wired elsewhere may come upon another one.
  void demand_own_inputs(const YamlFields& plant) const {
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
        if (is_free || unread_.contains(name)) continue;
        plant.at(name).fail(contact + " and " + other->second + " are both wired to " +
                            std::string(device.model->terminals[static_cast<std::size_t>(input)].name) +
                            "; expected one contact on an input, and `wires` for more");
      }
    }
  }

  std::pair<std::size_t, int> demand_terminal(const YamlFields& field, const std::string& name,
                                              TerminalRow::Kind kind, const char* example) const {
    const auto [device, terminal_name] = split(field, name, example);
    const Model& model = *bench_.devices[device].model;
    const int terminal = find_terminal(model, terminal_name);
    if (terminal >= 0 && model.terminals[static_cast<std::size_t>(terminal)].kind == kind)
      return {device, terminal};
    std::vector<std::string> names;
    for (const TerminalRow& row : model.terminals) {
      if (row.kind == kind) names.emplace_back(row.name);
    }
    field.fail(understudy::quoted(terminal_name) + " is not an " +
               (kind == TerminalRow::Kind::digital_in ? "input" : "output") + " of " +
               std::string(model.name) + suggestion(terminal_name, names));
  }

  void read_wires(const YamlFields& wires) {
    for (const YamlFields& wire : wires.elements()) {
      all_.attempt([&] { read_wire(wire); });
    }
  }

  void read_wire(const YamlFields& wire) {
    const std::string text = wire.text();
    const std::size_t arrow = text.find("->");
    if (arrow == std::string::npos)
      wire.fail("expected `DEVICE.OUTPUT -> DEVICE.INPUT`, or `DEVICE.AXIS.SWITCH -> DEVICE.INPUT`");
    const auto trimmed = [](std::string part) {
      part.erase(0, part.find_first_not_of(' '));
      return part.substr(0, part.find_last_not_of(' ') + 1);
    };
    WireSetup made;
    const std::string from = trimmed(text.substr(0, arrow));
    if (!find_contact(wire, from, made)) {
      std::tie(made.from_device, made.from_terminal) =
          demand_terminal(wire, from, TerminalRow::Kind::digital_out, "feeder.DOUT_4");
    }
    std::tie(made.to_device, made.to_terminal) = demand_terminal(
        wire, trimmed(text.substr(arrow + 2)), TerminalRow::Kind::digital_in, "turner.DIN_10");
    bench_.wires.push_back(made);
  }

  /// "feeder.A.upper_limit": whether it begins with an axis, so that a contact of its machine must be meant.
  bool find_contact(const YamlFields& wire, const std::string& name, WireSetup& made) const {
    const std::size_t dot = name.find_last_of('.');
    if (dot == std::string::npos || name.find('.') == dot) return false;
    const auto [device, axis_name] = split(wire, name.substr(0, dot), "feeder.A.home");
    const int axis = find_axis(*bench_.devices[device].model, axis_name);
    if (axis < 0) return false;
    const std::string word = name.substr(dot + 1);
    const auto* const found = std::find(kContactNames.begin(), kContactNames.end(), word);
    if (found == kContactNames.end()) {
      const std::vector<std::string> names(kContactNames.begin(), kContactNames.end());
      wire.fail(understudy::quoted(word) + " is not a switch of a machine" + suggestion(word, names));
    }
    made.from_device = device;
    made.from_axis = axis;
    made.from_contact = static_cast<Contact>(found - kContactNames.begin());
    for (const MachineSetup& machine : bench_.machines) {
      if (machine.device != device || machine.axis != axis) continue;
      if (PlantAxis(machine.plant).has_contact(made.from_contact)) return true;
    }
    if (unread_.contains(name.substr(0, dot))) throw Untold();
    wire.fail("the machine on " + name.substr(0, dot) + " has no " + word + "; expected it in `plant`");
  }

  // --- what only the model can judge -------------------------------------------------------------
  void check_devices() {
    const bool has_all_lines = all_.count() == 0;  // a station that could not be read may have had the device
    for (std::size_t i = 0; i < bench_.devices.size(); ++i) {
      all_.attempt([&] {
        if (!on_a_line_[i] && has_all_lines)
          device_fields_[i].fail("the device is on no line; expected a station that names it");
      });
      judge_device(device_fields_[i], bench_.devices[i], all_);
    }
  }

  // --- what is there from the beginning -----------------------------------------------------------
  void read_disturbances(const YamlFields& root) {
    KnownDevices known;
    for (const DeviceSetup& device : bench_.devices) {
      const Firmware firmware = device.settings.firmware;
      known.push_back(
          {device.settings.name, device.model, firmware != 0 ? firmware : device.model->firmwares.back()});
    }
    for (const LineSetup& line : bench_.lines) {
      for (const std::size_t device : line.stations) known[device].line = line.name;
    }
    all_.attempt([&] {
      if (!root.has("inputs")) return;
      all_.attempt([&] { root.at("inputs").demand_map(); });
      for (const auto& [name, level] : root.at("inputs").entries()) {
        all_.attempt([&, &called = name, &field = level] {
          if (names_unread(called)) throw Untold();
          bench_.inputs.push_back(read_input(field, called, known));
        });
      }
    });
    all_.attempt([&] {
      if (root.has("faults")) read_faults(root.at("faults").elements(), known);
    });
  }

  /// What they wait for is judged in a world without them.
  void read_faults(const std::vector<YamlFields>& elements, const KnownDevices& known) {
    std::vector<YamlFields> fields;
    std::vector<std::optional<Fault>> faults;
    for (const YamlFields& element : elements) {
      if (has_unread(element)) continue;
      fields.push_back(element);
      faults.push_back(read_fault(element, known, all_));
      if (faults.back()) bench_.faults.push_back(*faults.back());
    }
    const auto is_simple = [&](const std::optional<Fault>& fault) {
      return fault && speech_of(*bench_.devices[fault->device].model).takes_every_fault() &&
             fault->trigger.when.empty() && fault->kind != Fault::Kind::encoder_noise &&
             fault->kind != Fault::Kind::turn;
    };
    if (std::all_of(faults.begin(), faults.end(), is_simple)) return;
    Bench whole = bench_;
    whole.faults.clear();
    std::erase_if(whole.lines, [](const LineSetup& line) { return line.stations.empty(); });
    const World world(whole, {}, {});
    for (std::size_t i = 0; i < fields.size(); ++i) demand_possible(fields[i], world, faults[i], all_);
  }

  /// Whether a text names a part of the bench that could not be read, so that nothing can be said of it.
  bool names_unread(std::string_view text) const {
    const auto is_of_name = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
    };
    const auto is_named = [&](const std::string& name) {
      for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || !is_of_name(text[at - 1])) && (end == text.size() || !is_of_name(text[end])))
          return true;
      }
      return false;
    };
    return std::any_of(unknown_.begin(), unknown_.end(), is_named) ||
           std::any_of(unread_.begin(), unread_.end(), is_named);
  }
  bool has_unread(const YamlFields& fault) const {
    if (!fault.is_map()) return false;
    const auto entries = fault.entries();
    return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) {
      return entry.second.is_scalar() && names_unread(entry.second.text());
    });
  }

  ModelList models_;
  std::optional<std::string> folder_;
  std::optional<std::string> links_;
  Complaints all_;
  Bench bench_;
  std::set<std::string> unknown_;          // devices that could not be read
  std::set<std::string> unread_;           // lines and machines ("feeder.A"), or parts of them
  std::vector<YamlFields> device_fields_;  // where each device was described
  std::vector<bool> on_a_line_;
};

Bench read_whole(const std::string& text, const std::string& name, BenchReader reader) {
  const YamlFields root = YamlFields::parse(text, name, "bench", "`understudy: 1` and `lines:`");
  if (!root.has("lines") && (root.has("steps") || root.has("bench"))) {
    throw FileError({name, 1, 1},
                    "bench: is a scenario; expected a bench (`understudy run` plays scenarios)");
  }
  Complaints complaints;
  complaints.attempt([&] { root.demand_keys(kBenchKeys); });
  complaints.attempt([&] { root.at("understudy").integer(kVersionForm); });
  return reader.read(root, std::move(complaints));
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
  Complaints complaints;
  complaints.attempt([&] { fields.demand_keys(kInlineBenchKeys); });
  return BenchReader(models, folder).read(fields, std::move(complaints));
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
