#include "emulator/world/bench_file/disturbance_fields.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
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

/// Adds the fields to `text`, except the fields that could not be read.
void read_text_of_fault(const YamlFields& fields, std::string_view other_key, FaultText& text,
                        Diagnostics& diagnostics) {
  diagnostics.attempt([&] { fields.require_map(); });
  bool is_first = true;
  std::set<std::string> seen;
  for (const auto& [key, value] : fields.entries()) {
    if (!other_key.empty() && key == other_key) continue;
    if (!seen.insert(key).second) continue;
    if (is_first) text.kind = key;
    diagnostics.attempt([&, &name = key, &field = value] {
      if (std::exchange(is_first, false)) {
        text.place = field.text();
      } else {
        text.fields.emplace_back(name, field.text());
      }
    });
  }
  if (is_first) fields.fail("is empty; expected a fault, as in `{ stall: feeder.A }`");
}

/// Checks the condition of a fault that could not be read.
void check_condition_of(const YamlFields& when, const Inventory& inventory) {
  if (!when.is_scalar()) return;
  FaultTrigger trigger;
  try {
    set_trigger_field(trigger, "when", when.text());
  } catch (const NameError&) {
    throw AlreadyReported();  // is reported with the fault
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
  const std::size_t before = diagnostics.count();
  const bool has_kind =
      diagnostics.attempt([&] { read_text_of_fault(fields, other_key, text, diagnostics); });
  if (!has_kind) return std::nullopt;
  bool is_whole = diagnostics.count() == before;
  bool has_place = true;
  // Removes a wrong place or field, so that everything else can be checked.
  while (true) {
    try {
      if (!has_place) {
        require_fault_fields(devices, text);
        return std::nullopt;
      }
      const Fault fault = find_fault(devices, text);
      return is_whole ? std::optional(fault) : std::nullopt;
    } catch (const FaultFieldError& error) {
      is_whole = false;
      diagnostics.attempt([&] { fields.at(error.field).fail(error.diagnostic); });
      const auto is_it = [&](const auto& field) { return one_line(field.first) == error.field; };
      if (std::erase_if(text.fields, is_it) == 0) return std::nullopt;
    } catch (const FaultPlaceError& error) {
      has_place = false;
      if (!fields.at(text.kind).is_scalar()) continue;
      diagnostics.attempt([&] { fields.fail(error.what()); });
    } catch (const NameError& error) {
      // A field that was removed is not reported as missing.
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
