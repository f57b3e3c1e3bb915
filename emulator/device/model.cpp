#include "emulator/device/model.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/choices.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/command_window.h"
#include "emulator/device/device.h"
#include "emulator/device/firmware_message.h"
#include "emulator/device/memory/nv_entry_error.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/named_values.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/setting_entry.h"

namespace understudy::emulator {

ProgramMistake no_program(const Model& model) {
  return {.what = std::string(model.name) + " cannot load a program from a file; expected none"};
}

namespace {

/// Checks what all users of a model rely on. make_device() checks the facets of a device when it creates the
/// device.
const Model& whole(const Model& model) {
  if (model.line.ports.empty()) throw std::logic_error(std::string(model.name) + ": has no port on its line");
  for (const PortRow& port : model.line.ports) {
    if (port.bauds.empty())
      throw std::logic_error(std::string(model.name) + ": has no speed for its port " +
                             std::string(port.name));
  }
  if (model.firmwares.empty()) throw std::logic_error(std::string(model.name) + ": has no firmware");
  return model;
}

}  // namespace

const Model* find_model(ModelList models, std::string_view name) {
  const auto has_name = [&](const ListedModel& model) { return model.name() == name; };
  const auto found = std::find_if(models.begin(), models.end(), has_name);
  return found == models.end() ? nullptr : &whole(*static_cast<const Model*>(*found));
}

bool names_model_file(std::string_view name) { return name.ends_with(".yaml") || name.ends_with(".yml"); }

int find_terminal(const Model& model, std::string_view name) {
  for (std::size_t i = 0; i < model.terminals.size(); ++i) {
    if (model.terminals[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

const TerminalGroup* find_group(const Model& model, std::string_view name) {
  for (const TerminalGroup& group : model.terminal_groups) {
    if (group.name == name) return &group;
  }
  return nullptr;
}

const TerminalGroup* find_group_of(const Model& model, int first_terminal) {
  for (const TerminalGroup& group : model.terminal_groups) {
    if (group.first == first_terminal) return &group;
  }
  return nullptr;
}

int find_axis(const Model& model, std::string_view name) {
  for (std::size_t i = 0; i < model.axes.size(); ++i) {
    if (model.axes[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

std::optional<std::size_t> find_port(const Model& model, std::string_view name) {
  const auto ports = model.line.ports;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    if (ports[i].name == name) return i;
  }
  return std::nullopt;
}

std::string port_text(const Model& model, std::size_t port) {
  const auto ports = model.line.ports;
  return ports.size() > 1 ? " (" + std::string(ports[port].name) + ")" : std::string();
}

std::span<const RegisterRow> register_rows(const Model& model) {
  return model.registers == nullptr ? std::span<const RegisterRow>() : model.registers->rows();
}

std::optional<NamedPlace> find_register(const Model& model, std::string_view name, Firmware firmware) {
  return model.registers == nullptr ? std::nullopt : model.registers->find(name, firmware);
}

std::string why_no_register(const Model& model, std::string_view name, Firmware firmware) {
  static const RegisterMap none(std::span<const RegisterRow>(), MapPolicy{});
  return (model.registers == nullptr ? none : *model.registers).why_not(name, firmware);
}

Firmware parse_firmware(std::string_view text) {
  if (text.size() != 4 || text[1] != '.') return 0;
  int hundredths = 0;
  for (const std::size_t i : {0, 2, 3}) {
    if (text[i] < '0' || text[i] > '9') return 0;
    hundredths = hundredths * 10 + (text[i] - '0');
  }
  return static_cast<Firmware>(hundredths);
}

namespace {

template <typename Items, typename Format>
std::string list_of(const Items& items, Format format) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ", ") + format(item);
  return text;
}

}  // namespace

std::string why_no_firmware(const Model& model, const std::string& version) {
  return quoted(version) + " is unknown for " + std::string(model.name) + "; expected one of " +
         list_of(model.firmwares, version_text);
}

namespace {

/// Returns why a choice is refused. Adds the command that lists all choices if the message does not.
std::string why_no_choice(const std::string& why) {
  const bool has_all = why.find("expected one such as") == std::string::npos;
  return has_all ? why : why + " (`understudy describe` lists them)";
}

void check(const Model& model, const DeviceSettings& settings) {
  const auto& firmwares = model.firmwares;
  if (settings.firmware != 0 &&
      std::find(firmwares.begin(), firmwares.end(), settings.firmware) == firmwares.end()) {
    throw SettingError("firmware", why_no_firmware(model, version_text(settings.firmware)));
  }
  if (settings.modules != 0 && (settings.modules < 1 || settings.modules > model.max_modules)) {
    throw SettingError("modules", "'" + std::to_string(settings.modules) + "' is not valid; expected " +
                                      (model.max_modules == 0
                                           ? "none, because " + std::string(model.name) + " has no modules"
                                           : "1 to " + std::to_string(model.max_modules)));
  }
  const auto& numbers = model.line.station_numbers;
  const auto& number = settings.address;
  if (numbers && number && (*number < numbers->lowest || *number > numbers->highest)) {
    throw SettingError("address", std::to_string(*number) + " is not a station number of " +
                                      std::string(model.name) + "; expected " +
                                      std::to_string(numbers->lowest) + " to " +
                                      std::to_string(numbers->highest));
  }
  for (std::size_t port = 0; port < settings.bauds.size(); ++port) {
    const PortRow& row = model.line.ports[port];
    const int chosen = settings.bauds[port];
    if (chosen == 0 || std::find(row.bauds.begin(), row.bauds.end(), chosen) != row.bauds.end()) continue;
    throw SettingEntryError("baud", std::string(row.name),
                            std::to_string(chosen) + " is not a speed of " + std::string(model.name) +
                                port_text(model, port) + "; expected one of " +
                                list_of(row.bauds, [](int baud) { return std::to_string(baud); }));
  }
}

int require_switch(const Model& model, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.terminals.size(); ++i) {
    if (model.terminals[i].kind != TerminalRow::Kind::dip_switch) continue;
    if (model.terminals[i].name == name) return static_cast<int>(i);
    names.emplace_back(model.terminals[i].name);
  }
  throw SettingEntryError("dip", name,
                          quoted(name) + " is not a switch of " + std::string(model.name) +
                              suggestion(name, names, "it has none"));
}

void require_choices(const Model& model, const DeviceSettings& settings) {
  for (const auto& [id, option] : settings.choices) {
    try {
      resolve_choices(model.choices, {{id, option}});
    } catch (const ChoiceError& error) {
      throw SettingEntryError("choices", id, why_no_choice(error.what()));
    }
  }
}

/// Returns the shortest text that parses to this number.
std::string shortest_text(double number) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} ? std::string(text.data(), end) : std::string();
}

/// Writes a register. `given` is the value as the user wrote it. `value_for` returns nothing if the register
/// cannot contain the value.
void set_register(Device& device, const std::string& name, const std::string& given,
                  const std::function<std::optional<Value>(const NamedPlace&)>& value_for) {
  RegisterBank* const bank = device.register_bank();
  const auto place = find_register(device.model(), name, device.firmware());
  if (bank == nullptr || !place)
    throw SettingEntryError("set", name, why_no_register(device.model(), name, device.firmware()));
  const auto value = value_for(*place);
  switch (value ? write_value(*bank, *place, *value) : Refusal::bad_value) {
    case Refusal::none: break;
    case Refusal::no_register: {
      const std::string why = why_not_writable(*place);
      throw SettingEntryError("set", name, why, name + " " + why);
    }
    case Refusal::bad_value: {
      const std::string expected =
          "; expected " + (value ? range_text(*place, *value) : range_text(*place->place.row));
      throw SettingEntryError("set", name, given + " is out of range" + expected,
                              given + " is out of range for " + name + expected);
    }
    case Refusal::busy:
    case Refusal::failure: throw SettingEntryError("set", name, "the device does not accept it now");
  }
}

void set_registers(Device& device, const DeviceSettings& settings) {
  for (const auto& [name, value] : settings.set) {
    set_register(device, name, std::to_string(value), [&, &given = value](const NamedPlace& place) {
      return place.is_real() ? value_of_number(place, static_cast<double>(given)) : std::optional(given);
    });
  }
  for (const auto& [name, value] : settings.assignments) {
    if (device.register_bank() != nullptr) {
      set_register(device, name, shortest_text(value),
                   [&, &given = value](const NamedPlace& place) { return value_of_number(place, given); });
      continue;
    }
    if (device.named_values() == nullptr) {
      const std::string diagnostic = why_no_value(device, name);
      throw SettingEntryError("set", name, diagnostic, diagnostic);
    }
    if (const auto diagnostic = device.named_values()->assign(name, value))
      throw SettingEntryError("set", name, *diagnostic, name + ": " + *diagnostic);
  }
}

/// Writes the station number from the settings to the register that stores it. If the settings do not contain
/// one, the number in the memory does not change.
void set_station_number(Device& device) {
  const auto& numbers = device.model().line.station_numbers;
  if (!numbers || numbers->kept_in.empty() || !device.settings().address) return;
  const int number = *device.settings().address;
  set_register(device, std::string(numbers->kept_in), std::to_string(number),
               [&](const NamedPlace&) { return std::optional<Value>(number); });
}

void load_memory(Device& device, const NvImage& image) {
  if (device.memory() == nullptr)
    throw NvError(std::string(device.model().name) + " has no non-volatile memory; expected no NV image");
  // If the memory's content comes from the bench, it does not contain a firmware version.
  const auto& firmwares = device.model().firmwares;
  if (!image.firmware.empty() && image.model == device.model().name &&
      std::find(firmwares.begin(), firmwares.end(), parse_firmware(image.firmware)) == firmwares.end()) {
    const std::string why = why_no_firmware(device.model(), image.firmware);
    throw NvEntryError(NvEntryError::List::firmware, {}, {}, why, "firmware: " + why);
  }
  device.memory()->load_nv(image);
}

/// Checks that the device has the facets that its model's tables need.
void require_facets(const Device& device) {
  const Model& model = whole(device.model());
  const auto require = [&](bool is_present, std::string_view what) {
    if (!is_present) throw std::logic_error(std::string(model.name) + ": lacks " + std::string(what));
  };
  const auto find = [&](std::string_view name) { return find_register(model, name, device.firmware()); };
  const auto& numbers = model.line.station_numbers;
  require(!numbers || numbers->kept_in.empty() || find(numbers->kept_in),
          "the register of its station number");
  if (model.window != nullptr) {
    const auto window = find(model.window->register_name());
    require(window && window->place.row->table == Table::holding, "the register of its window");
  }
  require(model.registers == nullptr || device.register_bank() != nullptr,
          "the facet RegisterBankOf, for its registers");
  require(model.terminals.empty() || device.terminals() != nullptr, "the facet Terminals, for its terminals");
  require(model.axes.empty() || device.axes() != nullptr, "the facet Axes, for its axes");
  require(!model.rtu || device.modbus() != nullptr, "the facet ModbusStation, for its `rtu`");
  require(model.rtu || device.modbus() == nullptr, "an `rtu`, for its facet ModbusStation");
  require(model.language == nullptr || device.user_program() != nullptr,
          "the facet UserProgram, for its `language`");
  require(model.language != nullptr || device.user_program() == nullptr,
          "a `language`, for its facet UserProgram");
  for (const TerminalGroup& group : model.terminal_groups) {
    const auto rows = model.terminals.subspan(static_cast<std::size_t>(group.first));
    bool is_alike = group.count >= 1 && group.count <= TerminalGroup::kMax &&
                    static_cast<std::size_t>(group.count) <= rows.size();
    for (std::size_t i = 0; is_alike && i < static_cast<std::size_t>(group.count); ++i) {
      const TerminalRow::Kind kind = rows[i].kind;
      is_alike = kind == rows[0].kind &&
                 (kind == TerminalRow::Kind::digital_in || kind == TerminalRow::Kind::digital_out);
    }
    if (!is_alike) {
      throw std::logic_error(std::string(model.name) + ": " + std::string(group.name) +
                             " is not a group of digital inputs or outputs");
    }
  }
}

}  // namespace

DeviceSettings checked_settings(const Model& model, const DeviceSettings& given) {
  check(model, given);
  DeviceSettings settings = given;
  if (settings.firmware == 0) settings.firmware = model.firmwares.back();
  require_choices(model, settings);
  return settings;
}

std::vector<ProgramMistake> check_program(const Model& model, std::string_view text,
                                          const DeviceSettings& given) {
  const DeviceSettings settings = checked_settings(model, given);
  if (model.language == nullptr) return {no_program(model)};
  return model.language->check(text, settings);
}

std::vector<ProgramMistake> program_warnings(const Model& model, std::string_view text,
                                             const DeviceSettings& given) {
  const DeviceSettings settings = checked_settings(model, given);
  return model.language == nullptr ? std::vector<ProgramMistake>{} : model.language->warnings(text, settings);
}

std::unique_ptr<Device> make_device(const Model& model, const DeviceSettings& given,
                                    std::function<void(const std::string&)> log) {
  const DeviceSettings settings = checked_settings(model, given);
  std::unique_ptr<Device> device = model.make(settings);
  require_facets(*device);
  device->set_log(std::move(log));
  for (const auto& [name, on] : settings.dip) device->set_input(require_switch(model, name), on ? 1 : 0);
  if (settings.nv) load_memory(*device, *settings.nv);
  device->switch_power(true);
  for (std::size_t port = 0; port < given.bauds.size(); ++port) {
    const int baud = device->line_settings(port).baud;
    if (given.bauds[port] == 0 || baud == given.bauds[port] || device->keeps_its_speed()) continue;
    throw SettingError("dip", "the switches select " + std::to_string(baud) + " baud, but the line has " +
                                  std::to_string(given.bauds[port]) + "; expected the same");
  }
  if (!settings.program.empty()) load_program(*device, settings.program);
  set_station_number(*device);
  set_registers(*device, settings);
  if (PersistentMemory* const memory = device->memory()) memory->settle_memory();
  return device;
}

}  // namespace understudy::emulator
