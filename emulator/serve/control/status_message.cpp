#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "base/version.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/terminals.h"
#include "emulator/device/user_program.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/reply_text.h"
#include "emulator/serve/control/status_parts.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/serve/ports/port.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/stations/line_station.h"
#include "emulator/world/view/world_view.h"
#include "pty/line.h"
#include "pty/line_settings.h"
#include "pty/pseudo_terminal.h"

namespace understudy::emulator::serve {

namespace {

double microseconds(WallTime time) { return static_cast<double>(time.count()) / 1000.0; }

/// Describes a line without its stations.
Json line_status(const Daemon& daemon, const Port& port) {
  const world::WorldLine& line = daemon.world().line(port.line_number());
  const pty::LineCounters& counters = line.line.counters();
  const pty::PseudoTerminal* const terminal = port.terminal();
  Json status{{"name", line.line.name()},
              {"time_ns", daemon.world().now().count()},
              {"pty", terminal != nullptr ? terminal->path() : port.place()},
              {"link", port.place()},
              {"tcp", port.tcp_places()},
              {"settings", pty::to_string(line.line.options().settings)},
              {"timing", line.line.options().timing == pty::Timing::wire ? "wire" : "instant"},
              {"host", port.host_present() ? "open" : "closed"}};
  if (const auto host = port.host_settings(); port.host_present() && host) {
    status["host_baud"] = host->baud;
    status["host_settings"] = pty::to_string(*host);
  }
  status["bytes_in"] = counters.bytes_in;
  status["bytes_out"] = counters.bytes_out;
  status["bytes_unheard"] = counters.bytes_unheard;
  status["bytes_discarded"] = counters.bytes_discarded;
  status["collisions"] = counters.collisions;
  return status;
}

Json station_status(const world::LineStation& station) {
  const Device& device = station.device();
  Json entry{{"device", device.name()}};
  const auto& ports = device.model().line.ports;
  if (ports.size() > 1) entry["port"] = ports[station.port()].name;
  if (const auto number = device.station_number()) entry["address"] = *number;
  entry["requests"] = station.counters().requests;
  entry["replies"] = station.counters().replies;
  entry["exceptions"] = station.counters().exceptions;
  entry["bytes_dropped"] = station.dropped_bytes();
  return entry;
}

/// Returns the registers that best show what the device is doing.
Json telling_registers(const Device& device) {
  Json values = Json::object();
  for (const std::string_view name : device.model().state_registers) {
    const RegisterBank* const bank = device.register_bank();
    if (const auto place = bank != nullptr ? bank->find(name) : std::nullopt) {
      const Value value = read_value(*bank, *place);
      values[std::string(name)] = place->is_real() ? json_of(number_of(*place, value)) : Json(value);
    } else if (const NamedValues* const named = device.named_values()) {
      if (const auto value = named->value_named(name)) values[std::string(name)] = json_of(*value);
    }
  }
  return values;
}

bool runs_program(const Device& device) {
  using State = ProgramLocation::State;
  if (!device.powered() || device.user_program() == nullptr) return false;
  const std::vector<ProgramLocation> program_locations = device.user_program()->program_locations();
  return std::any_of(program_locations.begin(), program_locations.end(), [](const ProgramLocation& place) {
    return place.state == State::running || place.state == State::waiting;
  });
}

Json device_status(const world::World& world, std::size_t number) {
  const Device& device = world.device(number);
  Json status{{"name", device.name()},
              {"time_ns", world.now().count()},
              {"model", device.model().name},
              {"firmware", version_text(device.firmware())}};
  status["power"] = device.powered() ? "on" : "off";
  status["runs"] = runs_program(device);
  if (device.memory() != nullptr) status["kept_writes"] = device.memory()->memory_revision();
  const Axes* const axes = device.axes();
  if (axes != nullptr && !axes->pulse_format().empty()) status["pulse_format"] = axes->pulse_format();
  if (device.powered()) status["registers"] = telling_registers(device);
  status["inputs"] = Json::object();
  status["outputs"] = Json::object();
  // Counts and groups have their own objects, if there are any.
  for (const TerminalView& view : terminal_views(device)) {
    const bool is_count =
        view.what == TerminalView::What::pulses || view.kind == TerminalRow::Kind::counted_in;
    const bool is_word = view.what == TerminalView::What::word;
    const char* const key = is_word               ? "groups"
                            : is_count            ? "counts"
                            : is_input(view.kind) ? "inputs"
                                                  : "outputs";
    status[key][view.name] = value_of(device, view);
  }
  status["axes"] = Json::object();
  status["machines"] = Json::object();
  for (std::size_t axis = 0; axis < device.model().axes.size(); ++axis) {
    const auto place = static_cast<int>(axis);
    if (!axes->has_axis(place)) continue;
    const std::string name(device.model().axes[axis].name);
    status["axes"][name] =
        Json{{"pulses", world.sent_pulses(number, place)}, {"speed_pps", axes->speed_pps(place)}};
    if (const auto duty = axes->duty_percent(place)) status["axes"][name]["pwm_percent"] = *duty;
    const world::PlantAxis& plant = world.plant(number, place);
    Json& machine = status["machines"][name];
    machine = Json{{"position_pulses", plant.position_pulses()}, {"lost_pulses", plant.lost_pulses()}};
    if (plant.has_drive()) machine["drive"] = plant.in_alarm() ? "alarm" : plant.ready() ? "ready" : "off";
  }
  return status;
}

}  // namespace

bool StatusParts::add_next(ReplyText& text) {
  switch (part_) {
    case Part::head: add_head(text); return true;
    case Part::lines: add_of_line(text); return true;
    case Part::devices:
      if (next_ == daemon_.world().device_count()) {
        text.close_list();
        part_ = Part::faults;
      } else {
        text.element(device_status(daemon_.world(), next_++));
      }
      return true;
    case Part::faults:
      text.member("faults", faults_message_part(daemon_.world()));
      part_ = Part::end;
      return false;
    case Part::end: break;
  }
  return false;
}

void StatusParts::add_head(ReplyText& text) {
  daemon_.catch_up();
  const world::World& world = daemon_.world();
  const Pacer& pacer = daemon_.pacer();
  text.member("simulated_time", format_duration(world.now()));
  text.member("simulated_time_ns", world.now().count());
  text.member("speed", format_speed(pacer.speed()));
  text.member("paused", pacer.paused());
  text.member("lateness", {{"wakes", pacer.lateness().count()},
                           {"p50_us", microseconds(pacer.lateness().percentile(50))},
                           {"p99_us", microseconds(pacer.lateness().percentile(99))},
                           {"max_us", microseconds(pacer.lateness().max())},
                           {"slips", pacer.slips()}});
  text.member("ticks", {{"stepped", world.ticks_run()}, {"crossed", world.ticks_skipped()}});
  text.open_list("lines");
  part_ = Part::lines;
}

/// Adds the line itself, or the next one of its stations.
void StatusParts::add_of_line(ReplyText& text) {
  if (next_ == daemon_.ports().size()) {
    text.close_list();
    text.open_list("devices");
    next_ = 0;
    part_ = Part::devices;
    return;
  }
  const Port& port = *daemon_.ports()[next_];
  if (!is_in_line_) {
    text.open_object();
    text.members(line_status(daemon_, port));
    text.open_list("stations");
    is_in_line_ = true;
    return;
  }
  const auto& stations = daemon_.world().line(port.line_number()).stations;
  if (next_station_ < stations.size()) return text.element(station_status(*stations[next_station_++]));
  text.close_list();
  text.close_object();
  ++next_;
  next_station_ = 0;
  is_in_line_ = false;
}

ReplyTask status_message(Daemon& daemon, Json message) {
  require_keys(message, {"do"});
  const Pause pause(daemon);
  StatusParts parts(daemon);
  ReplyText text;
  text.open_object("status");
  while (parts.add_next(text)) co_await pause;
  text.close_object();
  co_return text.take();
}

Json identify_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do"});
  Json lines = Json::array();
  for (const auto& port : daemon.ports()) {
    const pty::PseudoTerminal* const terminal = port->terminal();
    const std::string link = terminal != nullptr
                                 ? std::filesystem::absolute(port->place()).lexically_normal().string()
                                 : port->place();
    lines.push_back({{"name", daemon.world().line(port->line_number()).line.name()},
                     {"pty", terminal != nullptr ? terminal->path() : link},
                     {"link", link},
                     {"tcp", port->tcp_places()}});
  }
  return Json{{"ok", true},
              {"daemon",
               {{"pid", getpid()},
                {"version", program_version()},
                {"protocol", kControlProtocol},
                {"bench", daemon.bench_path()},
                {"lines", lines}}}};
}

}  // namespace understudy::emulator::serve
