#include "emulator/play/reading/trial.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/suggestion.h"
#include "emulator/device/command_window.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/scenario/requests.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/disturbance_fields.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/check_fault.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/parser.h"
#include "emulator/world/expression/term.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/expression/tolerance.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/names/names.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

std::string to_text(const Limits& limits) {
  return std::to_string(limits.low) + " to " + std::to_string(limits.high);
}

/// Returns `feeder["Logic Position X"].4` without quotes and brackets, and other names unchanged.
std::string plain_name(const world::YamlFields& field, const std::string& written) {
  if (written.find('[') == std::string::npos) return written;
  try {
    world::Lexer lexer(written);
    const world::Token word = lexer.next();
    if (word.kind == world::Token::Kind::name && lexer.next().kind == world::Token::Kind::end)
      return word.name;
  } catch (const world::ExpressionError& error) {
    field.fail(error.what());
  }
  field.fail(quoted(written) + " is not a name; expected one such as feeder[\"Logic Position X\"]");
}

}  // namespace

Trial::Trial(const world::Bench& bench)
    : bench_(bench), world_(bench, world::WorldOptions{}, {}), probes_(world_) {}

std::size_t Trial::device(const world::YamlFields& field, const std::string& name) const {
  try {
    return world::find_device(known(), plain_name(field, name));
  } catch (const world::NameError& error) {
    field.fail(error.what());
  }
}

std::size_t Trial::line(const world::YamlFields& field, const std::string& name) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < bench_.lines.size(); ++i) {
    if (bench_.lines[i].name == name) return i;
    names.push_back(bench_.lines[i].name);
  }
  field.fail("no line is called " + quoted(name) + suggestion(name, names));
}

std::size_t Trial::line_of_all(const world::YamlFields& field,
                               const std::vector<std::size_t>& devices) const {
  const std::size_t number = line(field, field.text());
  for (const std::size_t device : devices) {
    std::string lines;
    bool is_present = false;
    for (std::size_t i = 0; i < bench_.lines.size(); ++i) {
      const auto& stations = bench_.lines[i].stations;
      if (std::none_of(stations.begin(), stations.end(),
                       [&](const auto& its) { return its.device == device; }))
        continue;
      is_present = is_present || i == number;
      lines += (lines.empty() ? "" : " or ") + bench_.lines[i].name;
    }
    if (!is_present)
      field.fail(known()[device].name + " is not on line " + quoted(field.text()) + "; expected " + lines);
  }
  return number;
}

Target Trial::target(const world::YamlFields& field, const std::string& written) const {
  Target target;
  target.name = written;
  const std::string name = plain_name(field, written);
  try {
    const std::size_t dot = name.find('.');
    std::string rest = name;
    for (std::size_t i = 0; i < known().size() && dot != std::string::npos; ++i) {
      if (name.compare(0, dot, known()[i].name) != 0) continue;
      target.device = i;
      rest = name.substr(dot + 1);
    }
    if (world::find_value(known(), name)) {
      probes_.resolve(name);
      target.is_value = true;
      return target;
    }
    const auto table = table_called(rest.substr(0, rest.find('.')));
    const std::string number = table ? rest.substr(rest.find('.') + 1) : rest;
    if (number.empty() || number.front() < '0' || number.front() > '9') {
      const world::RegisterName found = world::find_register(known(), name);
      target.device = found.device;
      target.place = found.place;
      return target;
    }
    if (rest == name) world::find_device(known(), known().size() == 1 ? "" : name.substr(0, dot));
    const auto address = parse_integer(number);
    if (!address || *address > UINT16_MAX) {
      field.fail(quoted(number) + " is not a register number; expected 0 to 0xFFFF");
    }
    target.table = table.value_or(Table::holding);
    target.address = static_cast<std::uint16_t>(*address);
    return target;
  } catch (const world::NameError& error) {
    field.fail(error.what());
  }
}

world::Expression Trial::expression(const world::YamlFields& field) const {
  const std::string text = field.text();
  try {
    world::ExpressionParser parser(text, probes_);
    const world::Term term = parser.expression();
    parser.expect_end();
    if (term.unit != world::Unit::none) {
      field.fail("is " + world::kind_of(term.unit) + "; expected a number, or a condition");
    }
    world::Expression expression = parser.take();
    if (expression.names.empty()) world::evaluate(expression, probes_);  // throws if there is never a result
    return expression;
  } catch (const world::ExpressionError& error) {
    field.fail(error.what());
  }
}

std::string Trial::condition(const world::YamlFields& field) const { return expression(field).text; }

std::string Trial::changing_condition(const world::YamlFields& field) const {
  const world::Expression condition = expression(field);
  if (condition.names.empty()) {
    field.fail(quoted(world::to_text(condition)) +
               " never changes; expected a condition that names something");
  }
  return condition.text;
}

std::vector<std::size_t> Trial::require_registers_only(const world::YamlFields& field) const {
  std::vector<std::size_t> devices;
  for (const world::Expression::Name& name : expression(field).names) {
    try {
      devices.push_back(world::find_register(known(), plain_name(field, name.spelling)).device);
    } catch (const world::NameError&) {
      field.fail(quoted(name.spelling) + " cannot be polled; expected registers only");
    }
  }
  return devices;
}

std::string Trial::value_to_write(const world::YamlFields& field, const Target& target,
                                  bool is_refused) const {
  const world::Expression value = expression(field);
  const RegisterRow* const row = target.place ? target.place->place.row : nullptr;
  if (!can_be_sent(target)) {
    field.fail(target.name + " cannot be written; no function writes to the table '" +
               std::string(to_string(table_of(target))) + "'");
  }
  if (row != nullptr && row->access == Access::read && !is_refused) {
    field.fail(target.name + " cannot be written; it is read-only (use `exception:` if the step tests that)");
  }
  if (!value.names.empty()) return value.text;
  const world::Number number = world::evaluate(value, probes_);
  const auto out_of = [&](const std::string& range) {
    field.fail(world::number_text(number) + " is out of range for " + target.name + "; expected " + range);
  };
  const auto fitting = value_for(target, number);
  const bool is_real = target.place && target.place->is_real();
  if (!fitting && is_real) field.fail(world::number_text(number) + " is too large for a 32-bit real");
  if (!fitting) field.fail(world::number_text(number) + " is not a whole number; expected one");
  const bool is_judged = row != nullptr && row->ranged && target.place->bit < 0 &&
                         target.place->place.part == Place::Part::whole && !is_refused &&
                         world_.device(target.device).register_bank()->map_policy().out_of_range ==
                             MapPolicy::OutOfRange::refused;
  if (is_real) {
    const float real = real_of(*fitting);
    if (is_judged && (real < real_of(row->min) || real > real_of(row->max))) out_of(range_text(*row));
    return value.text;
  }
  if (is_judged && (*fitting < row->min || *fitting > row->max)) out_of(range_text(*row));
  const Limits limits = limits_of(target);
  if (*fitting < limits.low || *fitting > limits.high) out_of(to_text(limits));
  return value.text;
}

void Trial::require_command(const world::YamlFields& field, std::size_t device) const {
  try {
    window_message(world_.device(device), field.text());
  } catch (const ProgramError& error) {
    field.fail(in_line(error.first()));
  }
}

world::Tolerance Trial::value_to_expect(const world::YamlFields& field, const Target& target) const {
  try {
    world::Tolerance value = world::parse_tolerance(field.text());
    if (target.is_value || (target.place && target.place->is_real())) return value;
    const Limits limits = limits_of(target);
    if ((value.low && *value.low > world::Number(limits.high)) ||
        (value.high && *value.high < world::Number(limits.low))) {
      const bool has_range = target.place && target.place->bit < 0 && target.place->place.row->ranged &&
                             target.place->place.part == Place::Part::whole;
      field.fail(target.name + " is never " + value.text + "; expected a value in " +
                 (has_range ? range_text(*target.place->place.row) : to_text(limits)));
    }
    return value;
  } catch (const world::ExpressionError& error) {
    field.fail(error.what());
  }
}

void Trial::require_program(const world::YamlFields& field, const ProgramStep& program) const {
  DeviceSettings settings = bench_.devices[program.device].settings;
  settings.program = program.text;
  try {
    make_device(*bench_.devices[program.device].model, settings);
  } catch (const ProgramError& error) {
    throw program.inside ? world::program_diagnostics(error, *program.inside)
                         : world::program_diagnostics(error, program.file);
  } catch (const SettingError& error) {
    field.fail(error.what());
  }
}

world::Fault Trial::fault(const world::YamlFields& field, std::string_view other_key) const {
  world::Diagnostics diagnostics;
  const auto fault = world::read_fault(field, known(), diagnostics, other_key);
  world::require_possible(field, world_, fault, diagnostics);
  diagnostics.throw_if_any();
  return *fault;
}

world::Fault Trial::turn(const world::YamlFields& field, const world::YamlFields* in,
                         const std::string& place) const {
  world::FaultText text{.kind = "turn", .place = place, .fields = {{"counts", field.text()}}};
  if (in != nullptr) text.fields.emplace_back("in", in->text());
  try {
    const world::Fault fault = world::find_fault(known(), text);
    world::check_fault(world_, fault);
    return fault;
  } catch (const world::FaultFieldError& error) {
    (error.field == "in" ? *in : field).fail(error.diagnostic);
  } catch (const world::NameError& error) {
    field.fail(error.what());
  }
}

void Trial::require_memory(const world::YamlFields& field, std::size_t device, const NvImage& image) const {
  DeviceSettings settings = bench_.devices[device].settings;
  settings.nv = image;
  settings.program.clear();
  try {
    make_device(*bench_.devices[device].model, settings);
  } catch (const NvError& error) {
    field.fail(error.what());
  } catch (const SettingError& error) {
    field.fail(error.what());
  }
}

}  // namespace understudy::emulator::play
