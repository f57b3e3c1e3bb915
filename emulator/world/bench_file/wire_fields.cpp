#include "emulator/world/bench_file/wire_fields.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_names.h"
#include "emulator/world/bench_file/complaints.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {

namespace {

/// "feeder.A.upper_limit": whether it begins with an axis, so that a contact of its machine must be meant.
bool find_contact(const YamlFields& wire, const std::string& name, const Bench& bench,
                  const BenchNames& names, WireSetup& made) {
  const std::size_t dot = name.find_last_of('.');
  if (dot == std::string::npos || name.find('.') == dot) return false;
  const auto [device, axis_name] = names.split(wire, name.substr(0, dot), "feeder.A.home");
  const int axis = find_axis(names.model_of(device), axis_name);
  if (axis < 0) return false;
  const std::string word = name.substr(dot + 1);
  const auto* const found = std::find(kContactNames.begin(), kContactNames.end(), word);
  if (found == kContactNames.end()) {
    const std::vector<std::string> contacts(kContactNames.begin(), kContactNames.end());
    wire.fail(quoted(word) + " is not a switch of a machine" + suggestion(word, contacts));
  }
  made.from_device = device;
  made.from_axis = axis;
  made.from_contact = static_cast<Contact>(found - kContactNames.begin());
  for (const MachineSetup& machine : bench.machines) {
    if (machine.device != device || machine.axis != axis) continue;
    if (PlantAxis(machine.plant).has_contact(made.from_contact)) return true;
  }
  if (names.is_lost_part(name.substr(0, dot))) throw Untold();
  wire.fail("the machine on " + name.substr(0, dot) + " has no " + word + "; expected it in `plant`");
}

}  // namespace

WireSetup read_wire(const YamlFields& wire, const Bench& bench, const BenchNames& names) {
  const std::string text = wire.text();
  const std::size_t arrow = text.find("->");
  if (arrow == std::string::npos)
    wire.fail("expected `DEVICE.OUTPUT -> DEVICE.INPUT`, or `DEVICE.AXIS.SWITCH -> DEVICE.INPUT`");
  const auto trimmed = [](std::string part) {
    part.erase(0, part.find_first_not_of(' '));
    return part.substr(0, part.find_last_not_of(' ') + 1);
  };
  WireSetup made;
  const std::string from = trimmed(text.substr(0, arrow));
  if (!find_contact(wire, from, bench, names, made)) {
    std::tie(made.from_device, made.from_terminal) =
        names.demand_terminal(wire, from, TerminalRow::Kind::digital_out, "feeder.DOUT_4");
  }
  std::tie(made.to_device, made.to_terminal) = names.demand_terminal(
      wire, trimmed(text.substr(arrow + 2)), TerminalRow::Kind::digital_in, "turner.DIN_10");
  return made;
}

}  // namespace understudy::emulator::world
