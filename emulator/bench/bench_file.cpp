#include "emulator/bench/bench_file.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "emulator/bench/bench_form.h"
#include "emulator/bench/machine_fields.h"
#include "emulator/bench/names.h"
#include "emulator/bench/yaml_fields.h"
#include "emulator/device.h"
#include "emulator/one_line.h"
#include "emulator/parse_real.h"
#include "emulator/suggestion.h"
#include "emulator/text_file.h"
#include "emulator/world/world.h"

namespace understudy::emulator {

namespace {

// Ports and memories are files that are named after lines and devices; a link has a lock beside it.
constexpr std::size_t kLongestName = 100;
constexpr std::size_t kLongestLinkName = 200;

/// A name that other names can be joined to with a dot.
void demand_name(const YamlFields& field, const std::string& name) {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  if (!plain) field.fail(emulator::quoted(name) + " is no name; expected letters, digits, _ and -");
  if (name.size() > kLongestName) {
    field.fail("has a name of " + std::to_string(name.size()) + " characters; expected at most " +
               std::to_string(kLongestName));
  }
}

class BenchReader {
 public:
  BenchReader(std::string folder, const std::string& links)
      : folder_(std::move(folder)), links_(links.empty() ? folder_ : links) {}

  /// From here on every path is refused.
  void refuse_paths() { has_paths_ = false; }

  Bench read(const YamlFields& root) {
    if (root.has("devices")) read_devices(root.at("devices"));
    read_lines(root.at("lines"));
    if (root.has("plant")) read_plant(root.at("plant"));
    if (root.has("wires")) read_wires(root.at("wires"));
    if (root.has("seed")) bench_.seed = static_cast<std::uint64_t>(root.at("seed").integer(kSeedForm));
    check_devices();
    read_disturbances(root);
    if (root.has("faults")) check_faults(root.at("faults").elements());
    return std::move(bench_);
  }

 private:
  // --- devices -------------------------------------------------------------------------------
  std::size_t add_device(const YamlFields& name_field, const std::string& name, const YamlFields& fields) {
    demand_name(name_field, name);
    if (find_device(name) >= 0)
      name_field.fail("two devices are called " + emulator::quoted(name) + "; expected a new name");
    DeviceSetup device;
    device.settings.name = name;
    const YamlFields model = fields.at("model");
    device.model = find_model(model.text());
    if (device.model == nullptr) {
      std::vector<std::string> names;
      for (const Model* known : all_models()) names.emplace_back(known->name);
      model.fail(emulator::quoted(model.text()) + " is no model" + suggestion(model.text(), names));
    }
    if (fields.has("firmware")) {
      const YamlFields firmware = fields.at("firmware");
      device.settings.firmware = parse_firmware(firmware.text());
      if (device.settings.firmware == 0)
        firmware.fail(emulator::quoted(firmware.text()) + " is no version; expected one like \"1.52\"");
    }
    if (fields.has("modules")) {
      device.settings.modules = static_cast<int>(fields.at("modules").integer(kModulesForm));
    }
    if (fields.has("set")) {
      fields.at("set").demand_map();
      for (const auto& [register_name, value] : fields.at("set").entries()) {
        if (device.model->protocol() == Protocol::text) {
          device.settings.assignments.emplace_back(register_name, demand_real(value));
          continue;
        }
        device.settings.set.emplace_back(register_name, value.integer(kRegisterValueForm));
      }
    }
    if (fields.has("dip")) {
      fields.at("dip").demand_map();
      for (const auto& [dip, level] : fields.at("dip").entries()) {
        device.settings.dip[dip] = level.on_or_off();
      }
    }
    if (fields.has("program")) read_program(fields.at("program"), device.settings);
    if (fields.has("nv")) read_nv(fields.at("nv"), device);
    if (fields.has("choices")) {
      fields.at("choices").demand_map();
      for (const auto& [id, option] : fields.at("choices").entries())
        device.settings.choices[id] = option.text();
    }
    bench_.devices.push_back(device);
    device_fields_.push_back(fields);
    on_a_line_.push_back(false);
    return bench_.devices.size() - 1;
  }

  static double demand_real(const YamlFields& field) {
    if (const auto value = parse_real(field.text())) return *value;
    field.fail(emulator::quoted(field.text()) + " is no number; expected one");
  }

  std::string path_in(const std::string& folder, const YamlFields& field) const {
    if (!has_paths_) field.fail("is a path; expected none in a recording, which has everything in itself");
    if (field.text().empty()) field.fail("is empty; expected a path");
    return (std::filesystem::path(folder) / field.text()).lexically_normal().string();
  }

  /// The path of a listing, or the listing itself if it has several lines.
  void read_program(const YamlFields& field, DeviceSettings& settings) {
    if (field.text().find('\n') != std::string::npos) {
      settings.program = field.text();
      settings.program_name = settings.name + ".program";
      return;
    }
    const std::string path = path_in(folder_, field);
    const auto text = read_text_file(path);
    if (!text) field.fail(path + " " + text.why + "; expected a listing");
    settings.program = *text;
    settings.program_name = path;
    bench_.files.push_back({path, "the program of " + emulator::quoted(settings.name)});
  }

  /// Of a model without registers: a whole number, a real one (it has a point), or the program.
  static void read_value_of_memory(const std::string& name, const YamlFields& value, NvImage& image) {
    const std::string text = value.text();
    if (name == "program") {
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);) image.program.push_back(line);
    } else if (text.find_first_of(".eE") == std::string::npos) {
      image.registers.emplace_back(name, value.integer(kRegisterValueForm));
    } else {
      image.reals.emplace_back(name, demand_real(value));
    }
  }

  /// The path of an image, or the registers themselves: those have no file, so what changes lasts as long as
  /// the run.
  void read_nv(const YamlFields& field, DeviceSetup& device) const {
    if (field.is_map()) {
      NvImage image{.model = std::string(device.model->name), .firmware = {}, .registers = {}};
      field.demand_map();
      for (const auto& [register_name, value] : field.entries()) {
        if (device.model->protocol() == Protocol::text) {
          read_value_of_memory(register_name, value, image);
          continue;
        }
        image.registers.emplace_back(register_name, value.integer(kRegisterValueForm));
      }
      device.settings.nv = std::move(image);
      return;
    }
    device.nv_path = path_in(folder_, field);
    for (const DeviceSetup& other : bench_.devices) {
      if (other.nv_path == device.nv_path) {
        field.fail("device " + emulator::quoted(other.settings.name) +
                   " has the same file; expected another");
      }
    }
  }

  void read_devices(const YamlFields& devices) {
    devices.demand_map();
    for (const auto& [name, fields] : devices.entries()) {
      fields.demand_keys(kDeviceKeys);
      add_device(fields, name, fields);
    }
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
    std::vector<std::string> names;
    for (const DeviceSetup& device : bench_.devices) names.push_back(device.settings.name);
    field.fail("no device is called " + emulator::quoted(name) + suggestion(name, names));
  }

  // --- lines ---------------------------------------------------------------------------------
  void read_lines(const YamlFields& lines) {
    lines.demand_map();
    if (lines.entries().empty()) lines.fail("has no line; expected at least one");
    for (const auto& [name, fields] : lines.entries()) read_line(name, fields);
  }

  void read_line(const std::string& name, const YamlFields& fields) {
    fields.demand_keys(kLineKeys);
    demand_name(fields, name);
    LineSetup line{.name = name, .link = {}, .stations = {}};
    if (fields.has("link")) {
      const YamlFields link = fields.at("link");
      line.link = path_in(links_, link);
      if (one_line(line.link) != line.link) link.fail("has a control character; expected a path without");
      if (const auto size = std::filesystem::path(line.link).filename().string().size();
          size > kLongestLinkName) {
        link.fail("has a name of " + std::to_string(size) + " characters; expected at most " +
                  std::to_string(kLongestLinkName));
      }
      const auto absolute = [](const std::string& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
      };
      for (const LineSetup& other : bench_.lines) {
        if (!other.link.empty() && absolute(other.link) == absolute(line.link))
          link.fail("line " + emulator::quoted(other.name) + " has the same link; expected another path");
      }
    }
    if (fields.has("baud")) line.baud = static_cast<int>(fields.at("baud").integer(kBaudForm));
    if (fields.has("baud_tolerance")) {
      const YamlFields tolerance = fields.at("baud_tolerance");
      const auto ppm = parse_baud_tolerance(tolerance.text());
      if (!ppm) {
        tolerance.fail(emulator::quoted(tolerance.text()) + " is not a share of the speed; " +
                       std::string(kBaudToleranceExpected));
      }
      line.baud_tolerance_ppm = *ppm;
    }
    if (fields.has("timing")) {
      const YamlFields timing = fields.at("timing");
      if (timing.text() != "wire" && timing.text() != "instant") {
        timing.fail(emulator::quoted(timing.text()) + " is no timing; expected wire or instant");
      }
      line.timing = timing.text() == "wire" ? pty::Timing::wire : pty::Timing::instant;
    }
    std::set<std::int64_t> addresses;
    const auto stations = fields.at("stations").elements();
    if (stations.empty()) fields.at("stations").fail("is empty; expected at least one station");
    for (const YamlFields& station : stations) read_station(station, line, addresses);
    bench_.lines.push_back(std::move(line));
  }

  void read_station(const YamlFields& station, LineSetup& line, std::set<std::int64_t>& addresses) {
    if (!station.is_map()) station.fail("expected a map, as in `key: value`");
    std::size_t device = 0;
    if (station.has("device")) {
      station.demand_keys(kPlacedStationKeys);
      device = demand_device(station.at("device"), station.at("device").text());
    } else {
      station.demand_keys(kStationKeys);
      device = add_device(station.at("name"), station.at("name").text(), station);
    }
    if (on_a_line_[device]) station.fail("the device is on a line already; expected it on one line");
    on_a_line_[device] = true;
    DeviceSetup& setup = bench_.devices[device];
    setup.settings.baud = line.baud;
    setup.settings.address = 1;
    const bool is_alone = setup.model->protocol() == Protocol::text;
    const auto is_text = [&](std::size_t other) {
      return bench_.devices[other].model->protocol() == Protocol::text;
    };
    if (!line.stations.empty() && (is_alone || is_text(line.stations.front()))) {
      const std::size_t speaker = is_alone ? device : line.stations.front();
      station.fail(emulator::quoted(bench_.devices[speaker].settings.name) +
                   " speaks text and must be alone on its line; expected no other station on it");
    }
    if (is_alone && station.has("address")) {
      station.at("address").fail(std::string(setup.model->name) + " has no station number; expected none");
    }
    if (station.has("address")) {
      const YamlFields address = station.at("address");
      setup.settings.address = static_cast<int>(
          address.integer(setup.model->rtu.lowest_address, setup.model->rtu.highest_address));
    }
    if (!addresses.insert(setup.settings.address).second) {
      station.fail("address " + std::to_string(setup.settings.address) +
                   " is taken on this line; expected another");
    }
    device_fields_[device] = station.has("device") ? device_fields_[device] : station;
    line.stations.push_back(device);
  }

  // --- plant and wires -------------------------------------------------------------------------
  /// "feeder.A" into the device and what is behind the dot.
  std::pair<std::size_t, std::string> split(const YamlFields& field, const std::string& name,
                                            const char* example) const {
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos)
      field.fail(emulator::quoted(name) + " names no device; expected a name like " + example);
    return {demand_device(field, name.substr(0, dot)), name.substr(dot + 1)};
  }

  void read_plant(const YamlFields& plant) {
    plant.demand_map();
    for (const auto& [name, fields] : plant.entries()) {
      const auto [device, axis_name] = split(fields, name, "feeder.A");
      const Model& model = *bench_.devices[device].model;
      const int axis = find_axis(model, axis_name);
      if (axis < 0) {
        std::string axes;
        for (const AxisRow& row : model.axes) axes += (axes.empty() ? "" : ", ") + std::string(row.name);
        fields.fail(emulator::quoted(axis_name) + " is no axis of " + std::string(model.name) +
                    "; expected one of " + axes);
      }
      bench_.machines.push_back({.device = device,
                                 .axis = axis,
                                 .plant = read_machine(fields, model.axes[static_cast<std::size_t>(axis)])});
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
    field.fail(emulator::quoted(terminal_name) + " is no " +
               (kind == TerminalRow::Kind::digital_in ? "input" : "output") + " of " +
               std::string(model.name) + suggestion(terminal_name, names));
  }

  void read_wires(const YamlFields& wires) {
    for (const YamlFields& wire : wires.elements()) {
      const std::string text = wire.text();
      const std::size_t arrow = text.find("->");
      if (arrow == std::string::npos) wire.fail("expected `DEVICE.OUTPUT -> DEVICE.INPUT`");
      const auto trimmed = [](std::string part) {
        part.erase(0, part.find_first_not_of(' '));
        return part.substr(0, part.find_last_not_of(' ') + 1);
      };
      const auto [from, output] = demand_terminal(wire, trimmed(text.substr(0, arrow)),
                                                  TerminalRow::Kind::digital_out, "feeder.DOUT_4");
      const auto [to, input] = demand_terminal(wire, trimmed(text.substr(arrow + 2)),
                                               TerminalRow::Kind::digital_in, "turner.DIN_10");
      bench_.wires.push_back(
          {.from_device = from, .from_terminal = output, .to_device = to, .to_terminal = input});
    }
  }

  // --- what only the model can judge -------------------------------------------------------------
  void check_devices() const {
    for (std::size_t i = 0; i < bench_.devices.size(); ++i) {
      if (!on_a_line_[i])
        device_fields_[i].fail("the device is on no line; expected a station that names it");
      try {
        make_device(*bench_.devices[i].model, bench_.devices[i].settings);
      } catch (const SettingError& error) {
        device_fields_[i].fail(error.what());
      } catch (const NvError& error) {
        device_fields_[i].fail(std::string("nv: ") + error.what());
      } catch (const ProgramError& error) {
        throw FileError(bench_.devices[i].settings.program_name + ":" + std::to_string(error.line) + ": " +
                        error.what());
      }
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
    if (root.has("inputs")) {
      root.at("inputs").demand_map();
      for (const auto& [name, level] : root.at("inputs").entries()) {
        bench_.inputs.push_back(read_input(level, name, known));
      }
    }
    if (root.has("faults")) {
      for (const YamlFields& fault : root.at("faults").elements()) {
        bench_.faults.push_back(read_fault(fault, known));
      }
    }
  }

  /// What faults wait for, in a world without them.
  void check_faults(const std::vector<YamlFields>& fields) const {
    const auto is_simple = [this](const Fault& fault) {
      return bench_.devices[fault.device].model->protocol() == Protocol::modbus_rtu &&
             fault.trigger.when.empty() && fault.kind != Fault::Kind::encoder_noise;
    };
    if (std::all_of(bench_.faults.begin(), bench_.faults.end(), is_simple)) return;
    Bench whole = bench_;
    whole.faults.clear();
    const World world(whole, {}, {});
    for (std::size_t i = 0; i < fields.size(); ++i) demand_possible(fields[i], world, bench_.faults[i]);
  }

  std::string folder_;
  std::string links_;
  bool has_paths_ = true;
  Bench bench_;
  std::vector<YamlFields> device_fields_;  // where each device was described
  std::vector<bool> on_a_line_;
};

YamlFields root_of(const std::string& text, const std::string& name) {
  const YamlFields root = YamlFields::parse(text, name, "bench", "`understudy: 1` and `lines:`");
  if (!root.has("lines") && (root.has("steps") || root.has("bench"))) {
    throw FileError({name, 1, 1},
                    "bench: is a scenario; expected a bench (`understudy run` plays scenarios)");
  }
  root.demand_keys(kBenchKeys);
  root.at("understudy").integer(kVersionForm);
  return root;
}

}  // namespace

Bench parse_bench(const std::string& text, const std::string& name, const std::string& folder,
                  const std::string& links) {
  return BenchReader(folder, links).read(root_of(text, name));
}

Bench parse_recorded_bench(const std::string& text) {
  BenchReader reader("", "");
  reader.refuse_paths();
  return reader.read(root_of(text, "bench"));
}

Bench read_bench(const YamlFields& fields, const std::string& folder) {
  fields.demand_keys(kInlineBenchKeys);
  return BenchReader(folder, "").read(fields);
}

namespace {

Bench bench_of(const std::string& text, const std::string& path, const std::string& links) {
  Bench bench = parse_bench(text, path, std::filesystem::path(path).parent_path().string(), links);
  bench.files.insert(bench.files.begin(), {path, "the bench itself"});
  return bench;
}

}  // namespace

Bench load_bench(const std::string& path, const std::string& links) {
  const auto text = read_text_file(path);
  if (!text) throw FileError(path + ": bench: " + text.why + "; expected a bench file");
  return bench_of(*text, path, links);
}

Bench load_bench(const YamlFields& path) {
  const auto text = read_text_file(path.path());
  if (!text) path.fail(path.path() + " " + text.why + "; expected a bench file");
  return bench_of(*text, path.path(), "");
}

}  // namespace understudy::emulator
