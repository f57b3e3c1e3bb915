#include "emulator/world/bench/bench_text.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/names/names.h"
#include "emulator/world/plant/plant.h"
#include "pty/line.h"
#include "pty/line_settings.h"

namespace understudy::emulator::world {

namespace {

using Json = nlohmann::ordered_json;

Json device_text(const DeviceSetup& device) {
  const DeviceSettings& settings = device.settings;
  // The final line ending distinguishes it from a path.
  const std::string_view description = device.model->description;
  Json text{{"model", description.empty() ? device.model->name : description}};
  if (settings.firmware != 0) text["firmware"] = version_text(settings.firmware);
  if (settings.modules != 0) text["modules"] = settings.modules;
  for (const auto& [name, on] : settings.dip) text["dip"][name] = on ? "on" : "off";
  if (settings.nv) {
    text["nv"] = Json::object();
    for (const auto& [name, value] : settings.nv->registers) text["nv"][name] = value;
    for (const auto& [name, value] : settings.nv->reals) text["nv"][name] = value;
    std::string program;
    for (const std::string& line : settings.nv->program) program += line + "\n";
    if (!program.empty()) text["nv"]["program"] = program;
    for (const auto& [kind, entries] : settings.nv->blocks) {
      text["nv"][kind] = Json::object();
      for (const auto& [name, block] : entries) text["nv"][kind][name] = block.text();
    }
  }
  if (!settings.program.empty()) {
    // The final line ending distinguishes it from a path.
    const bool has_lines = settings.program.find('\n') != std::string::npos;
    text["program"] = has_lines ? settings.program : settings.program + "\n";
  }
  for (const auto& [id, option] : settings.choices) text["choices"][id] = option;
  for (const auto& [name, value] : settings.set) text["set"][name] = value;
  for (const auto& [name, value] : settings.assignments) text["set"][name] = value;
  return text;
}

Json line_text(const Bench& bench, const LineSetup& line) {
  Json text{{"timing", line.timing == pty::Timing::wire ? "wire" : "instant"}, {"stations", Json::array()}};
  if (line.baud != 0) text["baud"] = line.baud;
  if (line.baud_tolerance_ppm != pty::kUsualBaudTolerancePpm) {
    const std::string part = std::to_string(10'000 + line.baud_tolerance_ppm % 10'000).substr(1);
    text["baud_tolerance"] = std::to_string(line.baud_tolerance_ppm / 10'000) + "." + part + "%";
  }
  if (line.echoes) text["echo"] = "on";
  if (line.byte_timeout != kUsualByteTimeout) text["byte_timeout"] = format_duration(line.byte_timeout);
  for (const auto& [device, port] : line.stations) {
    const DeviceSettings& settings = bench.devices[device].settings;
    const LineRules& rules = bench.devices[device].model->line;
    Json station{{"device", settings.name}};
    if (rules.ports.size() > 1) station["port"] = rules.ports[port].name;
    const bool is_in_memory =
        rules.station_numbers && !rules.station_numbers->kept_in.empty() && !settings.address;
    if (rules.station_numbers && !is_in_memory) station["address"] = settings.address.value_or(1);
    text["stations"].push_back(std::move(station));
  }
  return text;
}

Json machine_text(const PlantSetup& plant, const Model& model) {
  Json text = Json::object();
  const auto input = [&](int terminal) { return model.terminals[static_cast<std::size_t>(terminal)].name; };
  if (plant.position_pulses != 0) text["position"] = plant.position_pulses;
  if (plant.travel) text["travel"] = {plant.travel->first, plant.travel->last};
  if (plant.home) {
    text["home"] = Json{{"at", plant.home->first},
                        {"width", plant.home->last - plant.home->first + 1},
                        {"hysteresis", plant.home_hysteresis_pulses}};
  }
  if (plant.home_opens) text["home"]["contact"] = "opens";
  if (plant.home_input >= 0) text["home"]["input"] = input(plant.home_input);
  const auto add_switch = [&](const char* key, const std::optional<SwitchSetup>& setup) {
    if (!setup) return;
    text[key] = Json{{"at", setup->on.first},
                     {"width", setup->on.last - setup->on.first + 1},
                     {"hysteresis", setup->hysteresis_pulses}};
    if (setup->opens) text[key]["contact"] = "opens";
    if (setup->input >= 0) text[key]["input"] = input(setup->input);
  };
  add_switch("near_home", plant.near_home);
  add_switch("mark", plant.mark);
  if (plant.lower_limit) text["limits"]["lower"] = *plant.lower_limit;
  if (plant.upper_limit) text["limits"]["upper"] = *plant.upper_limit;
  if (plant.limit_hysteresis_pulses != 0) text["limits"]["hysteresis"] = plant.limit_hysteresis_pulses;
  if (plant.limits_open) text["limits"]["contact"] = "opens";
  if (plant.lower_limit_input >= 0) text["limits"]["lower_input"] = input(plant.lower_limit_input);
  if (plant.upper_limit_input >= 0) text["limits"]["upper_input"] = input(plant.upper_limit_input);
  if (plant.encoder_counts_per_revolution != 0) {
    text["encoder"] = Json{{"per_revolution", plant.encoder_counts_per_revolution},
                           {"motor_pulses_per_revolution", plant.pulses_per_revolution},
                           {"reversed", plant.encoder_reversed}};
    if (plant.has_wheel) text["encoder"]["on"] = "wheel";
    if (plant.index) {
      Json& index = text["encoder"]["index"];
      index = Json{{"at", plant.index->at}, {"width", plant.index->width}, {"period", plant.index->period}};
      if (plant.index->input >= 0) index["input"] = input(plant.index->input);
    }
  }
  if (plant.drive) {
    text["drive"] = Json{{"ready_after", std::to_string(plant.drive->ready_after) + "ms"},
                         {"enabled_by", plant.drive->enabled_by ? "on" : "off"},
                         {"alarm_contact", plant.drive->alarm_opens ? "opens" : "closes"}};
  }
  return text;
}

}  // namespace

std::string to_text(const Bench& bench) {
  const KnownDevices known = known_devices_of(bench);
  const auto terminal = [&](std::size_t device, int number) {
    return known[device].name + "." +
           std::string(known[device].model->terminals[static_cast<std::size_t>(number)].name);
  };
  Json text{{"understudy", 1}};
  text["lines"] = Json::object();
  for (const LineSetup& line : bench.lines) text["lines"][line.name] = line_text(bench, line);
  text["devices"] = Json::object();
  for (const DeviceSetup& device : bench.devices) text["devices"][device.settings.name] = device_text(device);
  for (const MachineSetup& machine : bench.machines) {
    const auto& axes = bench.devices[machine.device].model->axes;
    const std::string_view axis = axes[static_cast<std::size_t>(machine.axis)].name;
    text["plant"][known[machine.device].name + "." + std::string(axis)] =
        machine_text(machine.plant, *bench.devices[machine.device].model);
  }
  for (const WireSetup& wire : bench.wires) {
    const WireEnds ends = ends_of(wire, known);
    text["wires"].push_back(ends.from + " -> " + ends.to);
  }
  for (const InputSetup& input : bench.inputs) {
    text["inputs"][terminal(input.device, input.terminal)] = input.level;
  }
  for (const Fault& fault : bench.faults) {
    const FaultText parts = fault_text(known, fault);
    Json entry{{parts.kind, parts.place}};
    for (const auto& [name, value] : parts.fields) entry[name] = value;
    text["faults"].push_back(entry);
  }
  if (bench.seed != 0) text["seed"] = bench.seed;
  return text.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace understudy::emulator::world
