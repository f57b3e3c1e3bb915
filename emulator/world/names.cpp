#include "emulator/world/names.h"

#include <string>
#include <vector>

#include "emulator/one_line.h"

namespace understudy::emulator {

namespace {

struct Split {
  std::size_t device = 0;
  std::string_view rest;
};

Split split(const World& world, std::string_view name) {
  const std::size_t dot = name.find('.');
  if (dot != std::string_view::npos) {
    const int device = world.find_device(name.substr(0, dot));
    if (device >= 0) return {static_cast<std::size_t>(device), name.substr(dot + 1)};
  }
  if (world.device_count() == 1) return {0, name};
  std::vector<std::string> devices;
  for (std::size_t i = 0; i < world.device_count(); ++i) devices.push_back(world.device(i).name());
  const std::string first(name.substr(0, dot));
  throw NameError("no device is called " + quoted(first) + "; the nearest is '" +
                  nearest_word(first, devices) + "'");
}

}  // namespace

RegisterName find_register(const World& world, std::string_view name) {
  const auto [number, rest] = split(world, name);
  const Device& device = world.device(number);
  if (const auto place = device.registers().find(rest, device.firmware())) return {number, *place};
  throw NameError(device.name() + ": " + device.registers().why_not(rest, device.firmware()));
}

InputName find_input(const World& world, std::string_view name) {
  const auto [number, rest] = split(world, name);
  const Model& model = world.device(number).model();
  const int terminal = find_terminal(model, rest);
  if (terminal >= 0 &&
      model.terminals[static_cast<std::size_t>(terminal)].kind == TerminalRow::Kind::digital_in) {
    return {number, terminal};
  }
  std::vector<std::string> names;
  for (const TerminalRow& row : model.terminals) {
    if (row.kind == TerminalRow::Kind::digital_in) names.emplace_back(row.name);
  }
  throw NameError("no input of " + world.device(number).name() + " is called " + quoted(rest) +
                  "; the nearest is '" + nearest_word(rest, names) + "'");
}

}  // namespace understudy::emulator
