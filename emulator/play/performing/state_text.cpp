#include "emulator/play/performing/state_text.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/terminals.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

std::string registers_text(const Device& device) {
  std::string text;
  const auto add = [&](const std::string& name) {
    const RegisterBank* const bank = device.register_bank();
    const auto place = bank != nullptr ? bank->find(name) : std::nullopt;
    const NamedValues* const values = device.named_values();
    if (const auto number = place || values == nullptr ? std::nullopt : values->value_named(name)) {
      text += (text.empty() ? "" : ", ") + name + " " + world::number_text(world::Number(*number));
    }
    if (!place) return;
    const Value value = read_value(*bank, *place);
    text += (text.empty() ? "" : ", ") + name + " " +
            (place->is_real() ? value_text(value, Type::f32) : std::to_string(value));
    if (name != "STATUS") return;
    std::array<char, 16> hexadecimal{};
    std::snprintf(hexadecimal.data(), hexadecimal.size(), " (0x%04X)",
                  static_cast<unsigned>(value) & 0xFFFFU);
    text += hexadecimal.data();
  };
  for (const std::string_view name : device.model().state_registers) add(std::string(name));
  return text;
}

/// Returns true if an input's register still shows the earlier level, because the device reads its inputs
/// only in ticks.
bool is_read_later(const Device& device, const TerminalView& view, std::int64_t level) {
  if (view.kind != TerminalRow::Kind::digital_in || !device.powered()) return false;
  const RegisterBank* const bank = device.register_bank();
  const auto place = bank != nullptr ? bank->find(view.name) : std::nullopt;
  return place && read_value(*bank, *place) != level;
}

std::string terminals_text(const Device& device) {
  std::string text;
  for (const TerminalView& view : terminal_views(device)) {
    const std::int64_t value = value_of(device, view);
    if (value == 0) continue;
    text += (text.empty() ? "" : ", ") + view.name;
    const bool is_level = view.what == TerminalView::What::level && has_two_levels(view.kind);
    const world::Unit unit = is_in_millivolts(view.kind) ? world::Unit::millivolts : world::Unit::none;
    text += is_level ? " on" : " " + world::number_text(world::Number(value), unit);
    if (is_level && is_read_later(device, view, value)) text += " (read at the next tick)";
  }
  return text;
}

std::string axis_text(const world::World& world, std::size_t number, std::size_t axis) {
  const auto a = static_cast<int>(axis);
  const world::PlantAxis& plant = world.plant(number, a);
  std::string text = "pulses " + std::to_string(world.sent_pulses(number, a)) + ", speed " +
                     world::number_text(world::Number(world.device(number).axes()->speed_pps(a))) +
                     ", position " + std::to_string(plant.position_pulses());
  const int duty_percent = world.device(number).axes()->duty_percent(a).value_or(0);
  if (duty_percent != 0) text += ", PWM " + std::to_string(duty_percent) + " %";
  if (plant.lost_pulses() != 0) text += ", lost " + std::to_string(plant.lost_pulses());
  if (plant.at_home()) text += ", at home";
  if (plant.at_upper_limit()) text += ", at the upper limit";
  if (plant.at_lower_limit()) text += ", at the lower limit";
  if (plant.in_alarm()) text += ", in alarm";
  return text;
}

std::string fault_text(const world::World& world, std::size_t number, const world::ArmedFault& armed) {
  const auto& [fault, course] = armed;
  std::string text = "fault " + std::to_string(number) + " " + world::to_text(world.known(), fault) + ":";
  if (!world::is_of_frames(fault.kind)) text += course.in_force ? " in force" : " not in force";
  if (world::waits(fault)) {
    text += (world::is_of_frames(fault.kind) ? " hit " : ", hit ") + std::to_string(course.hits) + " of " +
            std::to_string(course.matched) + " that matched";
  } else if (world::is_of_frames(fault.kind)) {
    text += " in force";
  }
  return text;
}

}  // namespace

std::vector<std::string> device_state_text(const world::World& world, std::size_t number) {
  std::vector<std::string> texts;
  const Device& device = world.device(number);
  if (!device.powered()) {
    texts.push_back(device.name() + ": no power");
  } else if (const std::string registers = registers_text(device); !registers.empty()) {
    texts.push_back(device.name() + ": " + registers);
  }
  for (std::size_t a = 0; a < device.model().axes.size(); ++a) {
    if (!device.axes()->has_axis(static_cast<int>(a))) continue;
    texts.push_back(device.name() + "." + std::string(device.model().axes[a].name) + ": " +
                    axis_text(world, number, a));
  }
  if (const std::string terminals = terminals_text(device); !terminals.empty()) {
    texts.push_back(device.name() + ": " + terminals);
  }
  return texts;
}

std::vector<std::string> state_text(const world::World& world) {
  std::vector<std::string> texts;
  for (std::size_t d = 0; d < world.device_count(); ++d) {
    for (std::string& text : device_state_text(world, d)) texts.push_back(std::move(text));
  }
  for (const auto& [number, armed] : world.faults()) texts.push_back(fault_text(world, number, armed));
  return texts;
}

}  // namespace understudy::emulator::play
