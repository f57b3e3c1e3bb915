#include "tests/emulator/world/sleepers/act.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/terminals.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/names/names.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::world::sleepers {

namespace sleepers_act {

void write_place(World& world, const NamedPlace& place, Value value) {
  if (!place.place || !world.device(0).powered()) return;
  PreparedWrite write;
  if (prepare_value(*world.device(0).register_bank(), place, value, write) == Refusal::none)
    world.write(0, write);
}

Value some_value(Draw& draw, const RegisterRow& row) {
  const TypeLimits limits = row.ranged ? TypeLimits{row.min, row.max} : limits_of(row.type);
  switch (draw.between(0, 5)) {
    case 0: return draw.between(limits.lowest, limits.highest);
    case 1: return std::clamp<Value>(0, limits.lowest, limits.highest);
    case 2:
    case 3: return std::clamp<Value>(draw.between(0, 3), limits.lowest, limits.highest);
    default: return std::clamp<Value>(draw.of_any_size_and_sign(100'000), limits.lowest, limits.highest);
  }
}

Act any_write(Draw& draw, const RegisterMap& map) {
  for (;;) {
    const RegisterRow& row = draw.one_of(map.rows());
    if (row.access == Access::read || row.message != nullptr) continue;
    const auto index = static_cast<int>(draw.between(0, row.count - 1));
    const Value value = some_value(draw, row);
    const auto address = static_cast<std::uint16_t>(row.address + index * row.stride);
    return {.words = RegisterMap::name_of(row, index) + " = " + std::to_string(value),
            .carry_out = [table = row.table, address, value](World& world) {
              NamedPlace named{.place = world.device(0).register_bank()->at(table, address)};
              named.place.part = Place::Part::whole;
              write_place(world, named, value);
            }};
  }
}

Act any_input(Draw& draw, const Model& model) {
  for (;;) {
    const auto terminal = static_cast<int>(
        draw.between(0, std::min<std::int64_t>(200, static_cast<std::int64_t>(model.terminals.size()) - 1)));
    const TerminalRow& row = model.terminals[static_cast<std::size_t>(terminal)];
    if (!is_input(row.kind)) continue;
    const auto level = static_cast<std::int32_t>(row.kind == TerminalRow::Kind::counted_in
                                                     ? draw.between(-60, 200)
                                                     : draw.between(row.lowest, row.highest));
    const bool adds = row.kind == TerminalRow::Kind::counted_in;
    return {.words = std::string(row.name) + (adds ? " turned by " : " := ") + std::to_string(level),
            .carry_out = [=](World& world) {
              if (!world.device(0).terminals()->has_terminal(terminal)) return;
              world.set_external_input(0, terminal, level + (adds ? world.external_input(0, terminal) : 0));
            }};
  }
}

std::string some_input(Draw& draw, const Model& model, bool counted) {
  for (int tries = 0; tries < 500; ++tries) {
    const TerminalRow& row = draw.one_of(model.terminals);
    const bool fits =
        counted ? row.kind == TerminalRow::Kind::counted_in : is_input(row.kind) && has_two_levels(row.kind);
    if (fits) return "m." + std::string(row.name);
  }
  return "m.nothing";
}

Act any_fault(Draw& draw, const Model& model) {
  using Fields = std::vector<std::pair<std::string, std::string>>;
  const std::string axis = model.axes.empty() ? "n.A" : "m." + std::string(draw.one_of(model.axes).name);
  const std::string ms = draw.number(1, 400) + "ms";
  FaultText text;
  switch (draw.between(0, 11)) {
    case 0: text = {"stall", axis, {{"for", ms}}}; break;
    case 1: text = {"lost_steps", axis, {{"one_in", draw.number(1, 90)}, {"for", ms}}}; break;
    case 2: text = {"alarm", axis, {{"for", ms}}}; break;
    case 3:
      text = {"stuck", some_input(draw, model, false), {{"level", draw.number(0, 1)}, {"for", ms}}};
      break;
    case 4: text = {"slip", axis, {{"pulses", draw.number(-300, 300)}}}; break;
    case 5: text = {"turn", axis, {{"counts", draw.number(-3000, 3000)}, {"in", ms}}}; break;
    case 6:
      text = {"turn", some_input(draw, model, true), {{"counts", draw.number(-300, 300)}, {"in", ms}}};
      break;
    case 7:
      text = {"encoder_noise", axis, {{"counts", draw.number(1, 9)}, {"period", "8ms"}, {"for", ms}}};
      break;
    case 8: text = {"alarm", axis, Fields{}}; break;
    case 9: text = {"stuck", some_input(draw, model, false), {{"level", draw.number(0, 1)}}}; break;
    case 10: text = {"power_cut", "m", {{"at", draw.number(1, 20) + "s"}, {"for", ms}}}; break;
    default: text = {"corrupt_checksum", "m", {{"every", draw.number(1, 4)}, {"of", "request"}}}; break;
  }
  std::string words = text.kind + " " + text.place;
  for (const auto& [name, value] : text.fields) words += " " + name + "=" + value;
  return {.words = words, .carry_out = [text](World& world) {
            try {
              world.inject(find_fault(world.known(), text));
            } catch (const NameError&) {  // this bench does not have it
            }
          }};
}

/// Modbus messages: reads and writes anywhere, and invalid ones.
Act any_frame(Draw& draw) {
  const auto byte = [&](std::int64_t number) { return static_cast<std::uint8_t>(number); };
  std::vector<std::uint8_t> bytes{byte(draw.between(0, 2))};
  const std::int64_t address = draw.one_in(2) ? draw.between(0, 0xFFFF) : draw.of_any_size(0x4000);
  const std::int64_t function = draw.between(1, 6);
  const std::int64_t value = function < 5    ? draw.between(1, 8)
                             : function == 5 ? (draw.one_in(2) ? 0xFF00 : 0)
                                             : draw.between(0, 9);
  for (const std::int64_t number : {function, address >> 8, address, value >> 8, value})
    bytes.push_back(byte(number));
  if (!draw.one_in(8)) pty::append_rtu_crc(bytes);
  return frame_act(bytes);
}

Act power_act(Draw& draw) {
  const bool comes_back = !draw.one_in(3);
  const std::size_t device = draw.one_in(4) ? 1 : 0;
  return {.words = std::string("power of ") + (device == 0 ? "m" : "n") +
                   (comes_back ? " goes and comes" : " changes"),
          .carry_out = [=](World& world) {
            const bool had_power = world.device(device).powered();
            world.switch_power(device, !had_power);
            if (comes_back || !had_power) world.switch_power(device, true);
          }};
}

}  // namespace sleepers_act

Act write_act(const std::string& name, Value value) {
  return {.words = name + " = " + std::to_string(value), .carry_out = [=](World& world) {
            try {
              sleepers_act::write_place(world, find_register(world.known(), "m." + name).place, value);
            } catch (const NameError&) {
            }
          }};
}

Act assign_act(const std::string& name, double value) {
  return {.words = name + " := " + std::to_string(value),
          .carry_out = [=](World& world) { (void)world.assign(0, name, value); }};
}

Act command_act(const std::string& text) {
  return {.words = text, .carry_out = [=](World& world) {
            if (!world.device(0).powered()) return;
            try {
              (void)world.command(0, text);
            } catch (const ProgramError&) {
            }
          }};
}

Act line_act(const std::string& text) {
  Act act = frame_act({text.begin(), text.end()});
  act.words = text;
  return act;
}

Act frame_act(std::vector<std::uint8_t> bytes, std::size_t line) {
  std::string words = "bytes";
  for (const std::uint8_t byte : bytes) words += " " + std::to_string(byte);
  return {.words = words, .carry_out = [bytes = std::move(bytes), line](World& world) {
            if (world.line(line).line.room() >= bytes.size()) world.receive(line, bytes);
          }};
}

Act program_act(const std::string& text) {
  return {.words = "program:\n" + text, .carry_out = [=](World& world) {
            if (!world.device(0).powered()) return;
            try {
              world.load_program(0, text);
            } catch (const ProgramError&) {
            }
          }};
}

Act any_act(Draw& draw, const Model& model) {
  switch (draw.between(0, 11)) {
    case 0:
    case 1:
    case 2:
    case 3:
      if (model.registers != nullptr) return sleepers_act::any_write(draw, *model.registers);
      [[fallthrough]];
    case 4:
    case 5:
    case 6:
    case 7: return sleepers_act::any_input(draw, model);
    case 8: return sleepers_act::any_fault(draw, model);
    case 9:
      if (draw.one_in(3)) return sleepers_act::power_act(draw);
      return {.words = "all faults are mended", .carry_out = [](World& world) {
                // Except the one that makes the world run every tick.
                while (!world.faults().empty()) {
                  const auto last = std::prev(world.faults().end());
                  if (last->second.fault.kind == Fault::Kind::drop) break;
                  world.clear_fault(last->first);
                }
              }};
    case 10:
      if (model.registers != nullptr) return sleepers_act::any_frame(draw);
      [[fallthrough]];
    default: {
      const auto terminal = static_cast<int>(draw.between(0, 10));
      const bool on = draw.one_in(2);
      return {.words = "n.DIN_" + std::to_string(terminal) + " := " + (on ? "1" : "0"),
              .carry_out = [=](World& world) { world.set_external_input(1, terminal, on ? 1 : 0); }};
    }
  }
}

}  // namespace understudy::emulator::world::sleepers
