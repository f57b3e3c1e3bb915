#include "emulator/world/bench_file/disturbance_fields.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/check_fault.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/trigger.h"
#include "emulator/world/faults/trigger_text.h"
#include "emulator/world/names/level.h"
#include "emulator/world/names/names.h"
#include "emulator/world/view/inventory.h"

namespace understudy::emulator::world {

namespace {

FaultText text_of_fault(const YamlFields& fields, std::string_view other_key) {
  fields.require_map();
  FaultText text{};
  bool is_first = true;
  for (const auto& [key, value] : fields.entries()) {
    if (!other_key.empty() && key == other_key) continue;
    if (is_first) {
      is_first = false;
      text.kind = key;
      text.place = value.text();
      continue;
    }
    text.fields.emplace_back(key, value.text());
  }
  if (is_first) fields.fail("is empty; expected a fault, as in `{ stall: feeder.A }`");
  return text;
}

/// Checks the condition of a fault that could not be read.
void check_condition_of(const YamlFields& when, const Inventory& inventory) {
  if (!when.is_scalar()) return;
  FaultTrigger trigger;
  try {
    set_trigger_field(trigger, "when", when.text());
  } catch (const NameError&) {
    throw AlreadyReported();  // reported with the fault
  }
  try {
    check_condition(inventory, trigger.when);
  } catch (const NameError& error) {
    when.fail(error.what());
  }
}

}  // namespace

InputSetup read_input(const YamlFields& field, const std::string& name, const KnownDevices& devices) {
  try {
    const InputName input = find_input(devices, name);
    const TerminalRow& row = input.row(devices);
    const auto level = parse_level(field.text(), row.kind);
    if (!level)
      field.fail(quoted(field.text()) + " is not a level; expected " + std::string(level_example(row.kind)));
    require_level(row, name, *level);
    return {.device = input.device, .terminal = input.terminal, .level = static_cast<std::int32_t>(*level)};
  } catch (const NameError& error) {
    field.fail(error.what());
  }
}

std::optional<Fault> read_fault(const YamlFields& fields, const KnownDevices& devices,
                                Diagnostics& diagnostics, std::string_view other_key) {
  FaultText text{};
  if (!diagnostics.attempt([&] { text = text_of_fault(fields, other_key); })) return std::nullopt;
  // A wrong field is removed so that the others are judged. After that, errors about missing fields are not
  // reported.
  bool is_whole = true;
  while (true) {
    try {
      const Fault fault = find_fault(devices, text);
      return is_whole ? std::optional(fault) : std::nullopt;
    } catch (const FaultFieldError& error) {
      is_whole = false;
      diagnostics.attempt([&] { fields.at(error.field).fail(error.diagnostic); });
      const auto is_it = [&](const auto& field) { return one_line(field.first) == error.field; };
      if (std::erase_if(text.fields, is_it) == 0) return std::nullopt;
    } catch (const NameError& error) {
      if (is_whole) diagnostics.attempt([&] { fields.fail(error.what()); });
      return std::nullopt;
    }
  }
}

void require_possible(const YamlFields& fields, const Inventory& inventory, const std::optional<Fault>& fault,
                      Diagnostics& diagnostics) {
  diagnostics.attempt([&] {
    try {
      if (fault) return check_fault(inventory, *fault);
      if (const auto when = fields.find("when")) check_condition_of(*when, inventory);
    } catch (const FaultFieldError& error) {
      fields.at(error.field).fail(error.diagnostic);
    } catch (const NameError& error) {
      fields.fail(error.what());
    }
  });
}

}  // namespace understudy::emulator::world
