#include "emulator/bench/machine_fields.h"

#include "emulator/bench/bench_form.h"
#include "emulator/bench/level.h"
#include "emulator/one_line.h"
#include "emulator/suggestion.h"
#include "emulator/world/check_fault.h"

namespace understudy::emulator {

namespace {

PulseSpan read_span(const YamlFields& field) {
  const auto ends = field.elements();
  if (ends.size() != 2) field.fail("expected two positions, as in `[ -20000, 20000 ]`");
  const PulseSpan span{ends[0].integer(kPositionForm), ends[1].integer(kPositionForm)};
  if (span.first > span.last) field.fail("ends before it begins; expected the lower position first");
  return span;
}

/// One of two words; true for the first.
bool read_word(const YamlFields& field, std::string_view first, std::string_view second) {
  const std::string word = field.text();
  if (word != first && word != second) {
    field.fail(quoted(word) + " is unknown; expected " + std::string(first) + " or " + std::string(second));
  }
  return word == first;
}

DriveSetup read_drive(const YamlFields& drive) {
  drive.demand_keys(kDriveKeys);
  DriveSetup setup;
  if (drive.has("ready_after")) setup.ready_after = drive.at("ready_after").ticks();
  if (drive.has("enabled_by")) setup.enabled_by = read_word(drive.at("enabled_by"), "on", "off");
  if (drive.has("alarm_contact")) {
    setup.alarm_opens = read_word(drive.at("alarm_contact"), "opens", "closes");
  }
  return setup;
}

void read_encoder(const YamlFields& encoder, PlantSetup& setup) {
  encoder.demand_keys(kEncoderKeys);
  setup.encoder_counts_per_revolution =
      static_cast<int>(encoder.at("per_revolution").integer(kPerRevolutionForm));
  if (encoder.has("motor_pulses_per_revolution")) {
    setup.pulses_per_revolution =
        static_cast<int>(encoder.at("motor_pulses_per_revolution").integer(kPerRevolutionForm));
  }
  if (encoder.has("on")) setup.has_wheel = read_word(encoder.at("on"), "wheel", "machine");
  if (encoder.has("reversed")) setup.encoder_reversed = read_word(encoder.at("reversed"), "true", "false");
}

void read_travel(const YamlFields& travel, PlantSetup& setup) {
  const PulseSpan span = read_span(travel);
  if (span.first == span.last) travel.fail("is no way at all; expected two positions that differ");
  const std::int64_t start = setup.position_pulses;
  if (span.first > start || span.last < start) {
    travel.fail("does not hold position " + std::to_string(start) +
                ", where the machine starts; expected it inside");
  }
  setup.travel = span;
}

/// A digital input of the machine's own controller. (A wire goes to another's.)
int read_own_input(const YamlFields& field, const Model& model) {
  const std::string name = field.text();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.terminals.size(); ++i) {
    if (model.terminals[i].kind != TerminalRow::Kind::digital_in) continue;
    if (model.terminals[i].name == name) return static_cast<int>(i);
    names.emplace_back(model.terminals[i].name);
  }
  field.fail(quoted(name) + " is no input of " + std::string(model.name) + suggestion(name, names));
}

void read_home(const YamlFields& home, const Model& model, PlantSetup& setup) {
  home.demand_keys(kHomeKeys);
  const std::int64_t at = home.at("at").integer(kPositionForm);
  setup.home = PulseSpan{at, at + home.at("width").integer(kWidthForm) - 1};
  if (home.has("hysteresis")) setup.home_hysteresis_pulses = home.at("hysteresis").integer(kHysteresisForm);
  if (home.has("contact")) setup.home_opens = read_word(home.at("contact"), "opens", "closes");
  if (home.has("input")) setup.home_input = read_own_input(home.at("input"), model);
}

void read_limits(const YamlFields& limits, const Model& model, PlantSetup& setup) {
  limits.demand_keys(kLimitKeys);
  const auto read = [&](const char* side, std::optional<std::int64_t>& position, int& input) {
    const std::string input_key = std::string(side) + "_input";
    if (limits.has(side)) position = limits.at(side).integer(kPositionForm);
    if (!limits.has(input_key)) return;
    if (!position) {
      limits.at(input_key).fail("there is no " + std::string(side) + " limit switch; expected `" + side +
                                "` as well");
    }
    input = read_own_input(limits.at(input_key), model);
  };
  read("lower", setup.lower_limit, setup.lower_limit_input);
  read("upper", setup.upper_limit, setup.upper_limit_input);
  if (setup.lower_limit && setup.upper_limit && *setup.lower_limit >= *setup.upper_limit) {
    limits.fail("the lower limit is not below the upper one; expected it below");
  }
  if (limits.has("hysteresis"))
    setup.limit_hysteresis_pulses = limits.at("hysteresis").integer(kHysteresisForm);
  if (limits.has("contact")) setup.limits_open = read_word(limits.at("contact"), "opens", "closes");
}

}  // namespace

PlantSetup read_machine(const YamlFields& fields, const Model& model, int axis, Complaints& complaints) {
  PlantSetup setup;
  setup.pulses_per_revolution = model.axes[static_cast<std::size_t>(axis)].pulses_per_revolution;
  complaints.attempt([&] { fields.demand_keys(kMachineKeys); });
  const auto read = [&](const char* key, const auto& how) {
    complaints.attempt([&] {
      if (const auto field = fields.find(key)) how(*field);
    });
  };
  read("position", [&](const YamlFields& field) { setup.position_pulses = field.integer(kPositionForm); });
  read("travel", [&](const YamlFields& field) { read_travel(field, setup); });
  read("home", [&](const YamlFields& field) { read_home(field, model, setup); });
  read("limits", [&](const YamlFields& field) { read_limits(field, model, setup); });
  read("encoder", [&](const YamlFields& field) { read_encoder(field, setup); });
  read("drive", [&](const YamlFields& field) { setup.drive = read_drive(field); });
  return setup;
}

InputSetup read_input(const YamlFields& field, const std::string& name, const KnownDevices& devices) {
  try {
    const InputName input = find_input(devices, name);
    const TerminalRow& row = input.row(devices);
    const auto level = parse_level(field.text(), row.kind);
    if (!level)
      field.fail(quoted(field.text()) + " is no level; expected " + std::string(level_example(row.kind)));
    demand_level(row, name, *level);
    return {.device = input.device, .terminal = input.terminal, .level = static_cast<std::int32_t>(*level)};
  } catch (const NameError& error) {
    field.fail(error.what());
  }
}

void demand_possible(const YamlFields& fields, const World& world, const Fault& fault) {
  try {
    check_fault(world, fault);
  } catch (const FaultFieldError& error) {
    fields.at(error.field).fail(error.complaint);
  } catch (const NameError& error) {
    fields.fail(error.what());
  }
}

Fault read_fault(const YamlFields& fields, const KnownDevices& devices, std::string_view other_key) {
  fields.demand_map();
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
  try {
    return find_fault(devices, text);
  } catch (const FaultFieldError& error) {
    fields.at(error.field).fail(error.complaint);
  } catch (const NameError& error) {
    fields.fail(error.what());
  }
}

}  // namespace understudy::emulator
