// What there is on a bench: for onlookers who know none of its models.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/version.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/program_language.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/terminals.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/ports/port.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/fault_form.h"
#include "emulator/world/bench_file/form.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/kinds.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"
#include "pty/line.h"
#include "pty/line_settings.h"

namespace understudy::emulator::serve {

namespace {

Json span_of(const world::PulseSpan& span) { return Json::array({span.first, span.last}); }

Json switch_of(const world::PulseSpan& on, std::int64_t hysteresis, bool opens) {
  Json entry{{"on", span_of(on)}};
  if (hysteresis != 0) entry["hysteresis"] = hysteresis;
  if (opens) entry["opens"] = true;
  return entry;
}

/// Where the machine's switches lie, in pulses.
Json machine_of(const world::PlantSetup& setup) {
  Json machine{{"start", setup.position_pulses}};
  if (setup.travel) machine["travel"] = span_of(*setup.travel);
  const auto limit = [&](const char* key, const std::optional<std::int64_t>& at) {
    if (!at) return;
    Json entry{{"at", *at}};
    if (setup.limit_hysteresis_pulses != 0) entry["hysteresis"] = setup.limit_hysteresis_pulses;
    if (setup.limits_open) entry["opens"] = true;
    machine[key] = std::move(entry);
  };
  limit("lower_limit", setup.lower_limit);
  limit("upper_limit", setup.upper_limit);
  if (setup.home) machine["home"] = switch_of(*setup.home, setup.home_hysteresis_pulses, setup.home_opens);
  const auto passed = [&](const char* key, const std::optional<world::SwitchSetup>& which) {
    if (which) machine[key] = switch_of(which->on, which->hysteresis_pulses, which->opens);
  };
  passed("near_home", setup.near_home);
  passed("mark", setup.mark);
  if (setup.index) {
    machine["index"] =
        Json{{"at", setup.index->at}, {"width", setup.index->width}, {"period", setup.index->period}};
  }
  if (setup.encoder_counts_per_revolution != 0) {
    machine["encoder"] = Json{{"counts_per_revolution", setup.encoder_counts_per_revolution},
                              {"pulses_per_revolution", setup.pulses_per_revolution},
                              {"reversed", setup.encoder_reversed},
                              {"wheel", setup.has_wheel}};
  }
  machine["drive"] = setup.drive.has_value();
  return machine;
}

std::string_view kind_word(TerminalRow::Kind kind) {
  switch (kind) {
    case TerminalRow::Kind::digital_in: return "digital_in";
    case TerminalRow::Kind::digital_out: return "digital_out";
    case TerminalRow::Kind::analog_in: return "analog_in";
    case TerminalRow::Kind::analog_number: return "analog_number";
    case TerminalRow::Kind::dip_switch: return "dip_switch";
    case TerminalRow::Kind::counted_in: return "counted_in";
    case TerminalRow::Kind::analog_out: return "analog_out";
    case TerminalRow::Kind::pulse_out: return "pulse_out";
  }
  return {};
}

std::string_view name_of_terminal(const Model& model, int terminal) {
  return terminal < 0 ? std::string_view() : model.terminals[static_cast<std::size_t>(terminal)].name;
}

/// What the machines and drives use a terminal for: "A.home", "B.servo".
void add_functions(Json& terminals, const Model& model, const world::World& world, std::size_t device) {
  const auto add = [&](int terminal, const std::string& function) {
    if (terminal < 0) return;
    for (Json& entry : terminals) {
      if (entry["name"] == name_of_terminal(model, terminal)) entry["functions"].push_back(function);
    }
  };
  for (std::size_t a = 0; a < model.axes.size(); ++a) {
    const AxisRow& axis = model.axes[a];
    const world::PlantAxis& plant = world.plant(device, static_cast<int>(a));
    const std::string name = std::string(axis.name) + ".";
    for (std::size_t i = 0; i < world::kContactNames.size(); ++i) {
      const auto contact = static_cast<world::Contact>(i);
      const bool is_there = plant.has_contact(contact);
      add(is_there ? world::input_of(axis, plant, contact) : -1, name + std::string(world::kContactNames[i]));
    }
    add(axis.servo_output, name + "servo");
    add(axis.alarm_clear_output, name + "alarm_clear");
  }
}

Json sections_of(const Model& model) {
  Json sections = Json::array();
  std::string_view last = "\n";
  const auto count = [&](std::string_view section, int registers) {
    if (section == last) {
      sections.back()["rows"] = sections.back()["rows"].get<int>() + registers;
      return;
    }
    last = section;
    std::string_view english = section;
    for (const SectionRow& row : model.sections) {
      if (row.name == section) english = row.in_english;
    }
    sections.push_back(
        {{"number", sections.size()}, {"name", section}, {"english", english}, {"rows", registers}});
  };
  for (const RegisterRow& row : register_rows(model)) count(row.section, row.count);
  if (register_rows(model).empty() && !model.named_parameters.empty()) {
    sections.push_back(
        {{"number", 0}, {"name", ""}, {"english", "parameters"}, {"rows", model.named_parameters.size()}});
  }
  return sections;
}

Json controls_of(const ProgramLanguage& language) {
  using By = ProgramControl::By;
  Json controls = Json::array();
  for (const ProgramControl& control : language.controls()) {
    const char* const by = control.by == By::registers ? "set"
                           : control.by == By::command ? "command"
                                                       : "text";
    Json entry{{"word", control.word}, {by, control.what}};
    if (control.highest != 0) {
      entry["lowest"] = control.lowest;
      entry["highest"] = control.highest;
    }
    controls.push_back(std::move(entry));
  }
  return controls;
}

Json device_of(const Daemon& daemon, std::size_t number) {
  const world::World& world = daemon.world();
  const Device& device = world.device(number);
  const Model& model = device.model();
  Json axes = Json::array();
  for (std::size_t a = 0; a < model.axes.size(); ++a) {
    if (!device.axes()->has_axis(static_cast<int>(a))) continue;
    axes.push_back({{"name", model.axes[a].name},
                    {"pulses_per_revolution", model.axes[a].pulses_per_revolution},
                    {"machine", machine_of(world.machine(number, static_cast<int>(a)))}});
    if (model.axes[a].servo_output >= 0)
      axes.back()["servo"] = name_of_terminal(model, model.axes[a].servo_output);
  }
  Json terminals = Json::array();
  for (std::size_t i = 0; i < model.terminals.size(); ++i) {
    const TerminalRow& row = model.terminals[i];
    if (device.terminals() != nullptr && !device.terminals()->has_terminal(static_cast<int>(i))) continue;
    terminals.push_back({{"name", row.name}, {"kind", kind_word(row.kind)}});
    if (!has_two_levels(row.kind)) {
      terminals.back()["lowest"] = row.lowest;
      terminals.back()["highest"] = row.highest;
    }
    if (is_in_millivolts(row.kind)) terminals.back()["unit"] = "mV";
  }
  add_functions(terminals, model, world, number);
  Json groups = Json::array();
  for (const TerminalGroup& group : model.terminal_groups) {
    groups.push_back(
        {{"name", group.name}, {"first", name_of_terminal(model, group.first)}, {"count", group.count}});
  }
  Json details{{"name", device.name()},
               {"axes", std::move(axes)},
               {"terminals", std::move(terminals)},
               {"groups", std::move(groups)},
               {"state_registers", Json::array()},
               {"sections", sections_of(model)},
               {"registers", model.registers != nullptr},
               {"commands", !model.commands.empty() || model.window != nullptr}};
  for (const std::string_view name : model.state_registers) details["state_registers"].push_back(name);
  if (model.language != nullptr) {
    details["program"] = Json{{"language", model.language->name()},
                              {"file_ending", model.language->file_ending()},
                              {"controls", controls_of(*model.language)}};
  }
  details["gaps"] = Json::array();
  for (const std::string_view gap : model.gaps) details["gaps"].push_back(gap);
  return details;
}

}  // namespace

Json bench_message(Daemon& daemon, const Json& message) {
  demand_keys(message, {"do", "device"});
  const world::World& world = daemon.world();
  if (message.contains("device"))
    return Json{{"ok", true}, {"device", device_of(daemon, demand_device(daemon, message))}};
  Json lines = Json::array();
  for (const auto& port : daemon.ports()) {
    const world::WorldLine& line = world.line(port->line_number());
    Json stations = Json::array();
    for (const auto& station : line.stations) {
      const Device& device = station->device();
      Json entry{{"device", device.name()}, {"port", device.model().line.ports[station->port()].name}};
      if (const auto address = device.station_number()) entry["address"] = *address;
      stations.push_back(std::move(entry));
    }
    lines.push_back({{"name", line.line.name()},
                     {"pty", port->terminal() != nullptr ? port->terminal()->path() : port->place()},
                     {"link", port->place()},
                     {"tcp", port->tcp_places()},
                     {"settings", pty::to_string(line.line.options().settings)},
                     {"timing", line.line.options().timing == pty::Timing::wire ? "wire" : "instant"},
                     {"protocol", line.speech.protocol().name},
                     {"text", line.speech.carries_text()},
                     {"stations", std::move(stations)}});
  }
  Json devices = Json::array();
  for (std::size_t i = 0; i < world.device_count(); ++i) {
    const Device& device = world.device(i);
    Json axes = Json::array();
    for (std::size_t a = 0; a < device.model().axes.size(); ++a) {
      if (device.axes()->has_axis(static_cast<int>(a))) axes.push_back(device.model().axes[a].name);
    }
    devices.push_back({{"name", device.name()},
                       {"model", device.model().name},
                       {"title", device.model().title},
                       {"firmware", version_text(device.firmware())},
                       {"axes", std::move(axes)},
                       {"program", device.model().language != nullptr}});
  }
  Json wires = Json::array();
  for (const world::WireSetup& wire : world.wires()) {
    const Model& from = world.device(wire.from_device).model();
    const Model& to = world.device(wire.to_device).model();
    const std::string source =
        wire.from_axis < 0
            ? std::string(name_of_terminal(from, wire.from_terminal))
            : std::string(from.axes[static_cast<std::size_t>(wire.from_axis)].name) + "." +
                  std::string(world::kContactNames[static_cast<std::size_t>(wire.from_contact)]);
    wires.push_back({{"from", world.device(wire.from_device).name() + "." + source},
                     {"to", world.device(wire.to_device).name() + "." +
                                std::string(name_of_terminal(to, wire.to_terminal))}});
  }
  return Json{{"ok", true},
              {"bench",
               {{"path", daemon.bench_path()},
                {"version", program_version()},
                {"lines", std::move(lines)},
                {"devices", std::move(devices)},
                {"wires", std::move(wires)}}}};
}

namespace {

std::string_view place_word(world::FaultKindRow::Place place) {
  switch (place) {
    case world::FaultKindRow::Place::axis: return "axis";
    case world::FaultKindRow::Place::wheel: return "wheel";
    case world::FaultKindRow::Place::input: return "input";
    case world::FaultKindRow::Place::device: return "device";
    case world::FaultKindRow::Place::device_or_line: return "device_or_line";
  }
  return {};
}

std::string_view form_word(world::FaultFieldRow::Form form) {
  using Form = world::FaultFieldRow::Form;
  switch (form) {
    case Form::number: return "number";
    case Form::level: return "level";
    case Form::duration:
    case Form::ticks:
    case Form::even_ticks: return "duration";
    case Form::bytes: return "bytes";
    case Form::side: return "side";
  }
  return {};
}

std::string_view doc_of(std::string_view key) {
  for (const world::KeyRow& row : world::kFaultKeys) {
    if (row.key == key) return row.doc;
  }
  return {};
}

}  // namespace

Json faults_message(Daemon& /*daemon*/, const Json& message) {
  demand_keys(message, {"do"});
  Json kinds = Json::array();
  for (const world::FaultKindRow& kind : world::fault_kinds()) {
    Json fields = Json::array();
    for (const world::FaultFieldRow& field : kind.fields) {
      Json entry{{"name", field.name},
                 {"form", form_word(field.form)},
                 {"required", field.required},
                 {"doc", doc_of(field.name)}};
      if (field.form == world::FaultFieldRow::Form::number) {
        entry["lowest"] = field.lowest;
        entry["highest"] = field.highest;
      }
      fields.push_back(std::move(entry));
    }
    kinds.push_back({{"name", kind.name},
                     {"place", place_word(kind.place)},
                     {"doc", doc_of(kind.name)},
                     {"of_frames", world::is_of_frames(kind.kind)},
                     {"fields", std::move(fields)}});
  }
  // The trigger's fields stand behind those of the kinds, from "function" on.
  Json trigger = Json::array();
  const auto* const first = std::find_if(world::kFaultKeys.begin(), world::kFaultKeys.end(),
                                         [](const world::KeyRow& row) { return row.key == "function"; });
  for (const auto* row = first; row != world::kFaultKeys.end(); ++row) {
    trigger.push_back({{"name", row->key}, {"doc", row->doc}});
  }
  return Json{{"ok", true}, {"kinds", std::move(kinds)}, {"trigger", std::move(trigger)}};
}

}  // namespace understudy::emulator::serve
