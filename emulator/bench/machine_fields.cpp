#include "emulator/bench/machine_fields.h"

#include "emulator/bench/bench_form.h"
#include "emulator/bench/level.h"
#include "emulator/one_line.h"
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
  if (encoder.has("reversed")) setup.encoder_reversed = read_word(encoder.at("reversed"), "true", "false");
}

void read_travel(const YamlFields& travel, PlantSetup& setup) {
  const PulseSpan span = read_span(travel);
  if (span.first == span.last) travel.fail("is no way at all; expected two positions that differ");
  if (span.first > 0 || span.last < 0) {
    travel.fail("does not hold position 0, where the machine starts; expected it inside");
  }
  setup.travel = span;
}

void read_home(const YamlFields& home, PlantSetup& setup) {
  home.demand_keys(kHomeKeys);
  const std::int64_t at = home.at("at").integer(kPositionForm);
  setup.home = PulseSpan{at, at + home.at("width").integer(kWidthForm) - 1};
  if (home.has("hysteresis")) setup.home_hysteresis_pulses = home.at("hysteresis").integer(kHysteresisForm);
}

void read_limits(const YamlFields& limits, PlantSetup& setup) {
  limits.demand_keys(kLimitKeys);
  if (limits.has("lower")) setup.lower_limit = limits.at("lower").integer(kPositionForm);
  if (limits.has("upper")) setup.upper_limit = limits.at("upper").integer(kPositionForm);
  if (setup.lower_limit && setup.upper_limit && *setup.lower_limit >= *setup.upper_limit) {
    limits.fail("the lower limit is not below the upper one; expected it below");
  }
  if (limits.has("hysteresis"))
    setup.limit_hysteresis_pulses = limits.at("hysteresis").integer(kHysteresisForm);
}

}  // namespace

PlantSetup read_machine(const YamlFields& fields, const AxisRow& axis, Complaints& complaints) {
  PlantSetup setup;
  setup.pulses_per_revolution = axis.pulses_per_revolution;
  complaints.attempt([&] { fields.demand_keys(kMachineKeys); });
  const auto read = [&](const char* key, const auto& how) {
    complaints.attempt([&] {
      if (const auto field = fields.find(key)) how(*field, setup);
    });
  };
  read("travel", read_travel);
  read("home", read_home);
  read("limits", read_limits);
  read("encoder", read_encoder);
  read("drive", [](const YamlFields& drive, PlantSetup& of) { of.drive = read_drive(drive); });
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
