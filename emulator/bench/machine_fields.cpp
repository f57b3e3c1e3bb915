#include "emulator/bench/machine_fields.h"

#include "emulator/bench/level.h"

namespace understudy::emulator {

namespace {

constexpr std::int64_t kFar = 1'000'000'000'000;  // pulses; farther than any counter

PulseSpan read_span(const YamlFields& field) {
  const auto ends = field.elements();
  if (ends.size() != 2) field.fail("expected two positions, as in `[ -20000, 20000 ]`");
  const PulseSpan span{ends[0].integer(-kFar, kFar), ends[1].integer(-kFar, kFar)};
  if (span.first > span.last) field.fail("ends before it begins; expected the lower position first");
  return span;
}

/// One of two words; true for the first.
bool read_word(const YamlFields& field, std::string_view first, std::string_view second) {
  const std::string word = field.text();
  if (word != first && word != second) {
    field.fail("'" + word + "' is unknown; expected " + std::string(first) + " or " + std::string(second));
  }
  return word == first;
}

DriveSetup read_drive(const YamlFields& drive) {
  drive.demand_map({"ready_after", "enabled_by", "alarm_contact"});
  DriveSetup setup;
  if (drive.has("ready_after")) setup.ready_after = drive.at("ready_after").ticks();
  if (drive.has("enabled_by")) setup.enabled_by = read_word(drive.at("enabled_by"), "on", "off");
  if (drive.has("alarm_contact")) {
    setup.alarm_opens = read_word(drive.at("alarm_contact"), "opens", "closes");
  }
  return setup;
}

void read_encoder(const YamlFields& encoder, PlantSetup& setup) {
  encoder.demand_map({"per_revolution", "motor_pulses_per_revolution", "reversed"});
  setup.encoder_counts_per_revolution = static_cast<int>(encoder.at("per_revolution").integer(1, 10'000'000));
  if (encoder.has("motor_pulses_per_revolution")) {
    setup.pulses_per_revolution =
        static_cast<int>(encoder.at("motor_pulses_per_revolution").integer(1, 10'000'000));
  }
  if (encoder.has("reversed")) setup.encoder_reversed = read_word(encoder.at("reversed"), "true", "false");
}

}  // namespace

PlantSetup read_machine(const YamlFields& fields, const AxisRow& axis) {
  fields.demand_map({"travel", "home", "limits", "encoder", "drive"});
  PlantSetup setup;
  if (fields.has("travel")) {
    setup.travel = read_span(fields.at("travel"));
    if (setup.travel->first > 0 || setup.travel->last < 0) {
      fields.at("travel").fail("does not hold position 0, where the machine starts; expected it inside");
    }
  }
  if (fields.has("home")) {
    const YamlFields home = fields.at("home");
    home.demand_map({"at", "width", "hysteresis"});
    const std::int64_t at = home.at("at").integer(-kFar, kFar);
    setup.home = PulseSpan{at, at + home.at("width").integer(1, kFar) - 1};
    if (home.has("hysteresis")) setup.home_hysteresis_pulses = home.at("hysteresis").integer(0, kFar);
  }
  if (fields.has("limits")) {
    const YamlFields limits = fields.at("limits");
    limits.demand_map({"lower", "upper", "hysteresis"});
    if (limits.has("lower")) setup.lower_limit = limits.at("lower").integer(-kFar, kFar);
    if (limits.has("upper")) setup.upper_limit = limits.at("upper").integer(-kFar, kFar);
    if (setup.lower_limit && setup.upper_limit && *setup.lower_limit >= *setup.upper_limit) {
      limits.fail("the lower limit is not below the upper one; expected it below");
    }
    if (limits.has("hysteresis")) setup.limit_hysteresis_pulses = limits.at("hysteresis").integer(0, kFar);
  }
  setup.pulses_per_revolution = axis.pulses_per_revolution;
  if (fields.has("encoder")) read_encoder(fields.at("encoder"), setup);
  if (fields.has("drive")) setup.drive = read_drive(fields.at("drive"));
  return setup;
}

InputSetup read_input(const YamlFields& field, const std::string& name, const KnownDevices& devices) {
  try {
    const InputName input = find_input(devices, name);
    const TerminalRow& row = input.row(devices);
    const auto level = parse_level(field.text(), row.kind);
    if (!level) field.fail("'" + field.text() + "' is no level; expected " + std::string(level_example(row.kind)));
    demand_level(row, name, *level);
    return {.device = input.device, .terminal = input.terminal, .level = static_cast<std::int32_t>(*level)};
  } catch (const NameError& error) {
    field.fail(error.what());
  }
}

Fault read_fault(const YamlFields& fields, const KnownDevices& devices) {
  fields.demand_map({});
  FaultText text;
  for (const auto& [key, value] : fields.entries()) {
    if (text.kind.empty()) {
      text.kind = key;
      text.place = value.text();
    } else {
      text.amounts.emplace_back(key, value.integer(INT64_MIN, INT64_MAX));
    }
  }
  try {
    return find_fault(devices, text);
  } catch (const NameError& error) {
    fields.fail(error.what());
  }
}

}  // namespace understudy::emulator
