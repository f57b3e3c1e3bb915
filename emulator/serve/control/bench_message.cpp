// Describes a bench for observers that have no information about its models.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/version.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/program_language.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/terminals.h"
#include "emulator/serve/control/first_move.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/reply_text.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/ports/port.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/stations/line_station.h"
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

/// Returns the positions of the machine's switches, in pulses.
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

/// Returns, for each terminal, how machines and drives use it: "A.home", "B.servo".
std::vector<std::vector<std::string>> functions_of(const Model& model, const world::World& world,
                                                   std::size_t device) {
  std::vector<std::vector<std::string>> functions(model.terminals.size());
  const auto add = [&](int terminal, std::string function) {
    if (terminal >= 0) functions[static_cast<std::size_t>(terminal)].push_back(std::move(function));
  };
  for (std::size_t a = 0; a < model.axes.size(); ++a) {
    const AxisRow& axis = model.axes[a];
    const world::PlantAxis& plant = world.plant(device, static_cast<int>(a));
    const std::string name = std::string(axis.name) + ".";
    for (std::size_t i = 0; i < world::kContactNames.size(); ++i) {
      const auto contact = static_cast<world::Contact>(i);
      const bool is_present = plant.has_contact(contact);
      add(is_present ? world::input_of(axis, plant, contact) : -1,
          name + std::string(world::kContactNames[i]));
    }
    add(axis.servo_output, name + "servo");
    add(axis.alarm_clear_output, name + "alarm_clear");
  }
  return functions;
}

template <class Names>
Json names_json(const Names& names) {
  Json list = Json::array();
  for (const std::string_view name : names) list.push_back(name);
  return list;
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

Json axis_of(const world::World& world, std::size_t device, std::size_t place) {
  const AxisRow& row = world.device(device).model().axes[place];
  Json axis{{"name", row.name},
            {"pulses_per_revolution", row.pulses_per_revolution},
            {"machine", machine_of(world.machine(device, static_cast<int>(place)))}};
  if (row.servo_output >= 0) axis["servo"] = name_of_terminal(world.device(device).model(), row.servo_output);
  return axis;
}

/// Returns the register that makes the controller use a terminal for its function: a register that the model
/// specifies for its limit inputs, or a persistent switch whose name in the manual contains the terminal
/// (DIN2_Aaxis_UP_Limit, for DIN_2). Returns an empty text if there is none.
std::string_view register_using(const Model& model, const TerminalRow& terminal) {
  const auto number = static_cast<int>(&terminal - model.terminals.data());
  for (const AxisRow& axis : model.axes) {
    if (axis.upper_limit_input == number && !axis.upper_limit_used_by.empty())
      return axis.upper_limit_used_by;
    if (axis.lower_limit_input == number && !axis.lower_limit_used_by.empty())
      return axis.lower_limit_used_by;
  }
  std::string begin(terminal.name);
  std::erase(begin, '_');
  begin += '_';
  for (const RegisterRow& row : register_rows(model)) {
    if (row.persistent && row.min == 0 && row.max == 1 && row.name.starts_with(begin)) return row.name;
  }
  return {};
}

Json terminal_of(const TerminalRow& row, const std::vector<std::string>& functions,
                 std::string_view used_by) {
  Json terminal{{"name", row.name}, {"kind", kind_word(row.kind)}};
  if (!used_by.empty()) terminal["used_by"] = used_by;
  if (!has_two_levels(row.kind)) {
    terminal["lowest"] = row.lowest;
    terminal["highest"] = row.highest;
  }
  if (is_in_millivolts(row.kind)) terminal["unit"] = "mV";
  for (const std::string& function : functions) terminal["functions"].push_back(function);
  return terminal;
}

/// Describes everything that an observer needs to show the device `only`, or all devices.
ReplyTask device_message(Daemon& daemon, std::optional<std::size_t> only) {
  const Pause pause(daemon);
  const world::World& world = daemon.world();
  ReplyText text;
  if (!only) text.open_list("devices");
  for (std::size_t number = only.value_or(0); number < (only ? *only + 1 : world.device_count()); ++number) {
    const Device& device = world.device(number);
    const Model& model = device.model();
    only ? text.open_object("device") : text.open_object();
    text.member("name", device.name());
    text.open_list("axes");
    for (std::size_t a = 0; a < model.axes.size(); ++a) {
      if (!device.axes()->has_axis(static_cast<int>(a))) continue;
      text.element(axis_of(world, number, a));
      co_await pause;
    }
    text.close_list();
    const auto functions = functions_of(model, world, number);
    text.open_list("terminals");
    for (std::size_t i = 0; i < model.terminals.size(); ++i) {
      if (device.terminals() != nullptr && !device.terminals()->has_terminal(static_cast<int>(i))) continue;
      text.element(terminal_of(model.terminals[i], functions[i], register_using(model, model.terminals[i])));
      co_await pause;
    }
    text.close_list();
    text.open_list("groups");
    for (const TerminalGroup& group : model.terminal_groups) {
      text.element(
          {{"name", group.name}, {"first", name_of_terminal(model, group.first)}, {"count", group.count}});
      co_await pause;
    }
    text.close_list();
    text.member("state_registers", names_json(model.state_registers));
    co_await pause;
    text.member("sections", sections_of(model));
    co_await pause;
    text.member("registers", model.registers != nullptr);
    text.member("commands", !model.commands.empty() || model.window != nullptr);
    if (model.language != nullptr) {
      Json program{{"language", model.language->name()},
                   {"file_ending", model.language->file_ending()},
                   {"controls", controls_of(*model.language)}};
      if (model.language->parts_run_at_once()) program["at_once"] = true;
      text.member("program", program);
    }
    if (Json moves = first_move_of(device); !moves.empty()) text.member("first_move", moves);
    text.member("gaps", names_json(model.known_limitations));
    text.close_object();
  }
  if (!only) text.close_list();
  co_return text.take();
}

Json line_of(const Daemon& daemon, const Port& port) {
  const world::WorldLine& line = daemon.world().line(port.line_number());
  return Json{{"name", line.line.name()},
              {"pty", port.terminal() != nullptr ? port.terminal()->path() : port.place()},
              {"link", port.place()},
              {"tcp", port.tcp_places()},
              {"settings", pty::to_string(line.line.options().settings)},
              {"timing", line.line.options().timing == pty::Timing::wire ? "wire" : "instant"},
              {"protocol", line.protocol.protocol().name},
              {"text", line.protocol.carries_text()}};
}

Json station_of(const world::LineStation& station) {
  const Device& device = station.device();
  Json entry{{"device", device.name()}, {"port", device.model().line.ports[station.port()].name}};
  if (const auto address = device.station_number()) entry["address"] = *address;
  return entry;
}

Json device_in_short(const Device& device) {
  Json axes = Json::array();
  for (std::size_t a = 0; a < device.model().axes.size(); ++a) {
    if (device.axes()->has_axis(static_cast<int>(a))) axes.push_back(device.model().axes[a].name);
  }
  return Json{{"name", device.name()},         {"model", device.model().name},
              {"title", device.model().title}, {"firmware", version_text(device.firmware())},
              {"axes", std::move(axes)},       {"program", device.model().language != nullptr}};
}

ReplyTask whole_bench_message(Daemon& daemon) {
  const Pause pause(daemon);
  const world::World& world = daemon.world();
  ReplyText text;
  text.open_object("bench");
  text.member("path", daemon.bench_path());
  text.member("version", program_version());
  text.open_list("lines");
  for (const auto& port : daemon.ports()) {
    text.open_object();
    text.members(line_of(daemon, *port));
    text.open_list("stations");
    for (const auto& station : world.line(port->line_number()).stations) {
      text.element(station_of(*station));
      co_await pause;
    }
    text.close_list();
    text.close_object();
  }
  text.close_list();
  text.open_list("devices");
  for (std::size_t i = 0; i < world.device_count(); ++i) {
    text.element(device_in_short(world.device(i)));
    co_await pause;
  }
  text.close_list();
  text.open_list("wires");
  for (const world::WireSetup& wire : world.wires()) {
    const world::WireEnds ends = ends_of(wire, world.known());
    text.element(Json{{"from", ends.from}, {"to", ends.to}});
    co_await pause;
  }
  text.close_list();
  text.close_object();
  co_return text.take();
}

}  // namespace

ReplyTask bench_message(Daemon& daemon, Json message) {
  require_keys(message, {"do", "device"});
  if (message.contains("device") && message["device"] == "*") return device_message(daemon, std::nullopt);
  if (message.contains("device")) return device_message(daemon, require_device(daemon, message));
  return whole_bench_message(daemon);
}

}  // namespace understudy::emulator::serve
