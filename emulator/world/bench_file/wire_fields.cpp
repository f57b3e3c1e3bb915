#include "emulator/world/bench_file/wire_fields.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_names.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {

namespace {

/// A contact or input of the machine on an axis: "feeder.A.upper_limit".
struct MachinePlace {
  std::size_t device = 0;
  int axis = 0;
  std::string axis_name;  // "feeder.A"
  std::string word;       // "upper_limit"
};

/// Returns nothing if the name does not begin with an axis, and therefore must be a terminal.
std::optional<MachinePlace> find_machine_place(const YamlFields& wire, const std::string& name,
                                               const BenchNames& names, const char* example) {
  const std::size_t dot = name.find_last_of('.');
  if (dot == std::string::npos || name.find('.') == dot) return std::nullopt;
  const auto [device, axis_name] = names.split(wire, name.substr(0, dot), example);
  const int axis = find_axis(names.model_of(device), axis_name);
  if (axis < 0) return std::nullopt;
  return MachinePlace{device, axis, name.substr(0, dot), name.substr(dot + 1)};
}

/// Returns the index of the place's word in `words`. `what` is the description of the words in the message.
template <class Names>
std::size_t find_word(const YamlFields& wire, const MachinePlace& place, const Names& words,
                      const char* what) {
  const auto* const found = std::find(words.begin(), words.end(), place.word);
  if (found == words.end()) {
    wire.fail(quoted(place.word) + " is not " + what +
              suggestion(place.word, std::vector<std::string>(words.begin(), words.end())));
  }
  return static_cast<std::size_t>(found - words.begin());
}

/// Reports an error unless the bench has a machine at that place for which `has` returns true.
template <class Has>
void require_machine(const YamlFields& wire, const MachinePlace& place, const Bench& bench,
                     const BenchNames& names, const std::string& what, Has has) {
  for (const MachineSetup& machine : bench.machines) {
    if (machine.device == place.device && machine.axis == place.axis && has(PlantAxis(machine.plant))) return;
  }
  if (names.is_lost_part(place.axis_name)) throw AlreadyReported();
  wire.fail("the machine on " + place.axis_name + " has no " + what + "; expected it in `plant`");
}

}  // namespace

WireSetup read_wire(const YamlFields& wire, const Bench& bench, const BenchNames& names,
                    Diagnostics& diagnostics) {
  const std::string text = wire.text();
  const std::size_t arrow = text.find("->");
  if (arrow == std::string::npos)
    wire.fail(
        "expected `DEVICE.OUTPUT -> DEVICE.INPUT`, or `DEVICE.AXIS.SWITCH -> DEVICE.INPUT`, or "
        "`DEVICE.OUTPUT -> DEVICE.AXIS.alarm_clear`");
  const auto trimmed = [](std::string part) {
    part.erase(0, part.find_first_not_of(' '));
    return part.substr(0, part.find_last_not_of(' ') + 1);
  };
  WireSetup made;
  const std::string from = trimmed(text.substr(0, arrow));
  const bool has_from = diagnostics.attempt([&] {
    if (const auto place = find_machine_place(wire, from, names, "feeder.A.home")) {
      made.from_device = place->device;
      made.from_axis = place->axis;
      made.from_contact =
          static_cast<Contact>(find_word(wire, *place, kContactNames, "a switch of a machine"));
      require_machine(wire, *place, bench, names, place->word,
                      [&](const PlantAxis& machine) { return machine.has_contact(made.from_contact); });
    } else {
      std::tie(made.from_device, made.from_terminal) =
          names.require_terminal(wire, from, TerminalRow::Kind::digital_out, "feeder.DOUT_4");
    }
  });
  const std::string to = trimmed(text.substr(arrow + 2));
  const bool has_to = diagnostics.attempt([&] {
    if (const auto place = find_machine_place(wire, to, names, "feeder.A.alarm_clear")) {
      made.to_device = place->device;
      made.to_axis = place->axis;
      made.to_input =
          static_cast<DriveInput>(find_word(wire, *place, kDriveInputNames, "an input of a drive"));
      require_machine(wire, *place, bench, names, "drive",
                      [](const PlantAxis& machine) { return machine.has_drive(); });
    } else {
      std::tie(made.to_device, made.to_terminal) =
          names.require_terminal(wire, to, TerminalRow::Kind::digital_in, "turner.DIN_10");
    }
  });
  if (!has_from || !has_to) throw AlreadyReported();
  return made;
}

}  // namespace understudy::emulator::world
