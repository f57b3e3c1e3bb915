#include "emulator/world/bench_file/machine_fields.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/model.h"
#include "emulator/world/bench_file/bench_schema.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/keys.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {

namespace {

PulseSpan read_span(const YamlFields& field, Diagnostics& diagnostics) {
  const auto ends = field.elements();
  if (ends.size() != 2) field.fail("expected two positions, as in `[ -20000, 20000 ]`");
  PulseSpan span{};
  const bool has_first = diagnostics.attempt([&] { span.first = ends[0].integer(kPositionSchema); });
  const bool has_last = diagnostics.attempt([&] { span.last = ends[1].integer(kPositionSchema); });
  if (!has_first || !has_last) throw AlreadyReported();
  if (span.first > span.last) field.fail("ends before it begins; expected the lower position first");
  return span;
}

/// Reads one of two words. Returns true for the first word.
bool read_word(const YamlFields& field, std::string_view first, std::string_view second) {
  const std::string word = field.text();
  if (word != first && word != second) {
    field.fail(quoted(word) + " is unknown; expected " + std::string(first) + " or " + std::string(second));
  }
  return word == first;
}

DriveSetup read_drive(const YamlFields& drive, Diagnostics& diagnostics) {
  const Keys keys(drive, kDriveKeys, diagnostics);
  DriveSetup setup;
  keys.read("ready_after", [&](const YamlFields& field) { setup.ready_after = field.ticks(); });
  keys.read("enabled_by", [&](const YamlFields& field) { setup.enabled_by = read_word(field, "on", "off"); });
  keys.read("alarm_contact",
            [&](const YamlFields& field) { setup.alarm_opens = read_word(field, "opens", "closes"); });
  return setup;
}

/// Reads the name of a digital input of the machine's own controller. (Only wires lead to other controllers.)
/// If the model is unknown, any name is accepted.
int read_own_input(const YamlFields& field, const Model* model) {
  const std::string name = field.text();
  if (model == nullptr) return -1;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model->terminals.size(); ++i) {
    if (model->terminals[i].kind != TerminalRow::Kind::digital_in) continue;
    if (model->terminals[i].name == name) return static_cast<int>(i);
    names.emplace_back(model->terminals[i].name);
  }
  field.fail(quoted(name) + " is not an input of " + std::string(model->name) + suggestion(name, names));
}

/// Reads an index. By default, its period is one revolution of the motor.
IndexSetup read_index(const YamlFields& index, const Model* model, int pulses_per_revolution,
                      Diagnostics& diagnostics) {
  const Keys keys(index, kIndexKeys, diagnostics);
  IndexSetup setup{.period = pulses_per_revolution};
  keys.read("at", [&](const YamlFields& field) { setup.at = field.integer(kPositionSchema); });
  keys.read("width", [&](const YamlFields& field) { setup.width = field.integer(kWidthSchema); });
  keys.read("period", [&](const YamlFields& field) { setup.period = field.integer(kWidthSchema); });
  keys.read("input", [&](const YamlFields& field) { setup.input = read_own_input(field, model); });
  diagnostics.attempt([&] {
    const bool is_known = setup.period > 0;  // otherwise read_encoder() reports the error
    if (!is_known || setup.width < setup.period) return;
    (index.has("width") ? index.at("width") : index)
        .fail("is on for " + std::to_string(setup.width) + " of " + std::to_string(setup.period) +
              " positions; expected fewer than its period");
  });
  return setup;
}

void read_encoder(const YamlFields& encoder, const Model* model, PlantSetup& setup,
                  Diagnostics& diagnostics) {
  const Keys keys(encoder, kEncoderKeys, diagnostics);
  const auto per_revolution = [](const YamlFields& field) {
    return static_cast<int>(field.integer(kPerRevolutionSchema));
  };
  keys.require("per_revolution",
               [&](const YamlFields& field) { setup.encoder_counts_per_revolution = per_revolution(field); });
  keys.read("motor_pulses_per_revolution",
            [&](const YamlFields& field) { setup.pulses_per_revolution = per_revolution(field); });
  keys.read("on", [&](const YamlFields& field) { setup.has_wheel = read_word(field, "wheel", "machine"); });
  diagnostics.attempt([&] {
    if (setup.pulses_per_revolution > 0 || encoder.has("motor_pulses_per_revolution")) return;
    if (!setup.has_wheel)
      encoder.fail("needs the pulses per revolution of the motor; expected `motor_pulses_per_revolution`");
    setup.pulses_per_revolution = 1;  // a wheel has no motor; 1 avoids a division by zero
  });
  keys.read("reversed",
            [&](const YamlFields& field) { setup.encoder_reversed = read_word(field, "true", "false"); });
  keys.read("index", [&](const YamlFields& field) {
    if (setup.has_wheel) field.fail("is on a hand wheel; expected an encoder on the machine");
    setup.index = read_index(field, model, setup.pulses_per_revolution, diagnostics);
  });
}

void read_travel(const YamlFields& travel, bool knows_start, PlantSetup& setup, Diagnostics& diagnostics) {
  const PulseSpan span = read_span(travel, diagnostics);
  if (span.first == span.last) travel.fail("has no length; expected two positions that differ");
  const std::int64_t start = setup.position_pulses;
  if (knows_start && (span.first > start || span.last < start)) {
    travel.fail("does not include position " + std::to_string(start) +
                ", where the machine starts; expected a range with this position");
  }
  setup.travel = span;
}

SwitchSetup read_switch(const YamlFields& fields, const Model* model, Diagnostics& diagnostics) {
  const Keys keys(fields, kHomeKeys, diagnostics);
  SwitchSetup setup;
  std::int64_t at = 0;
  std::int64_t width = 1;
  keys.require("at", [&](const YamlFields& field) { at = field.integer(kPositionSchema); });
  keys.require("width", [&](const YamlFields& field) { width = field.integer(kWidthSchema); });
  setup.on = {at, at + width - 1};
  keys.read("hysteresis",
            [&](const YamlFields& field) { setup.hysteresis_pulses = field.integer(kHysteresisSchema); });
  keys.read("contact", [&](const YamlFields& field) { setup.opens = read_word(field, "opens", "closes"); });
  keys.read("input", [&](const YamlFields& field) { setup.input = read_own_input(field, model); });
  return setup;
}

void read_home(const YamlFields& home, const Model* model, PlantSetup& setup, Diagnostics& diagnostics) {
  const SwitchSetup switch_setup = read_switch(home, model, diagnostics);
  setup.home = switch_setup.on;
  setup.home_hysteresis_pulses = switch_setup.hysteresis_pulses;
  setup.home_opens = switch_setup.opens;
  setup.home_input = switch_setup.input;
}

void read_limits(const YamlFields& limits, const Model* model, PlantSetup& setup, Diagnostics& diagnostics) {
  const Keys keys(limits, kLimitKeys, diagnostics);
  const auto read = [&](const std::string& side, std::optional<std::int64_t>& position, int& input) {
    keys.read(side, [&](const YamlFields& field) { position = field.integer(kPositionSchema); });
    keys.read(side + "_input", [&](const YamlFields& field) {
      if (!limits.has(side)) {
        field.fail("there is no " + side + " limit switch; expected `" + side + "`");
      }
      input = read_own_input(field, model);
    });
  };
  read("lower", setup.lower_limit, setup.lower_limit_input);
  read("upper", setup.upper_limit, setup.upper_limit_input);
  diagnostics.attempt([&] {
    if (setup.lower_limit && setup.upper_limit && *setup.lower_limit >= *setup.upper_limit) {
      limits.fail("the lower limit is not below the upper one; expected `lower` below `upper`");
    }
  });
  keys.read("hysteresis", [&](const YamlFields& field) {
    setup.limit_hysteresis_pulses = field.integer(kHysteresisSchema);
  });
  keys.read("contact",
            [&](const YamlFields& field) { setup.limits_open = read_word(field, "opens", "closes"); });
}

}  // namespace

int require_axis(const YamlFields& fields, const Model& model, const std::string& name) {
  const int axis = find_axis(model, name);
  if (axis >= 0) return axis;
  std::string axes;
  for (const AxisRow& row : model.axes) axes += (axes.empty() ? "" : ", ") + std::string(row.name);
  fields.fail(quoted(name) + " is not an axis of " + std::string(model.name) + "; expected one of " + axes);
}

PlantSetup read_machine(const YamlFields& fields, const Model* model, const AxisRow* axis,
                        Diagnostics& diagnostics) {
  PlantSetup setup;
  setup.pulses_per_revolution = axis != nullptr ? axis->pulses_per_revolution : 1;
  const Keys keys(fields, kMachineKeys, diagnostics);
  const bool knows_start = keys.read(
      "position", [&](const YamlFields& field) { setup.position_pulses = field.integer(kPositionSchema); });
  keys.read("travel", [&](const YamlFields& field) { read_travel(field, knows_start, setup, diagnostics); });
  keys.read("home", [&](const YamlFields& field) { read_home(field, model, setup, diagnostics); });
  keys.read("near_home",
            [&](const YamlFields& field) { setup.near_home = read_switch(field, model, diagnostics); });
  keys.read("mark", [&](const YamlFields& field) { setup.mark = read_switch(field, model, diagnostics); });
  keys.read("limits", [&](const YamlFields& field) { read_limits(field, model, setup, diagnostics); });
  keys.read("encoder", [&](const YamlFields& field) { read_encoder(field, model, setup, diagnostics); });
  keys.read("drive", [&](const YamlFields& field) { setup.drive = read_drive(field, diagnostics); });
  return setup;
}

}  // namespace understudy::emulator::world
