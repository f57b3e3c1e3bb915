#include "emulator/model_file/axis_fields.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "base/text/suggestion.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/binder.h"
#include "emulator/model_file/line_fields.h"
#include "emulator/model_file/model_schema.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::model_file {

using models::imported::AxisBinding;
using models::imported::Command;
using models::imported::Description;
using models::imported::Number;
using models::imported::Quantity;
using models::imported::View;
using world::YamlFields;

namespace {

bool is_time(Number number) {
  return number == Number::acceleration_time || number == Number::deceleration_time;
}

/// Reads "10" or "25/4".
motion::UnitScale read_scale(const YamlFields& field) {
  const std::string text = field.text();
  const std::size_t slash = text.find('/');
  const auto multiplier = parse_integer(text.substr(0, slash));
  const auto divider = slash == std::string::npos ? 1 : parse_integer(text.substr(slash + 1));
  const auto is_one = [](std::optional<std::int64_t> number) {
    return number && *number >= 1 && *number <= INT32_MAX;
  };
  if (!is_one(multiplier) || !is_one(divider))
    field.fail(understudy::quoted(text) +
               " is not valid; expected a whole number above 0, or a fraction such as 25/4");
  return motion::UnitScale::of(*multiplier, *divider);
}

double read_factor(const YamlFields& field) {
  const auto factor = parse_real(field.text());
  if (!factor || !(*factor > 0) || *factor > 1e9)
    field.fail(understudy::quoted(field.text()) + " is not valid; expected a number above 0 and up to 1e9");
  return *factor;
}

int read_input(const YamlFields& field, const Description& description) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < description.terminals.size(); ++i) {
    if (!description.terminals[i].is_input) continue;
    if (description.terminals[i].name == field.text()) {
      const auto& spot = description.terminals[i].spot;
      if (!spot || !spot->is_whole() || description.registers[spot->number].type == Type::bit)
        return static_cast<int>(i);
      field.fail(understudy::quoted(field.text()) + " is a number; expected an input that is on or off");
    }
    names.push_back(description.terminals[i].name);
  }
  field.fail(understudy::quoted(field.text()) + " is not an input" +
             suggestion(field.text(), names, "the model has no `inputs`"));
}

/// A key that requires another key.
struct Need {
  std::string_view key;
  std::string_view needed;
  std::string_view instead{};  // a key that can replace `needed`
};
constexpr std::array<Need, 10> kNeeds{{{"start", "target"},
                                       {"start", "speed"},
                                       {"start_relative", "distance"},
                                       {"start_relative", "speed"},
                                       {"forward", "speed"},
                                       {"backward", "speed"},
                                       {"home", "home_speed", "speed"},
                                       {"target", "start"},
                                       {"distance", "start_relative"},
                                       {"while_disabled", "enable"}}};
/// These keys exclude each other.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kEither{
    {{"acceleration_time", "acceleration"}, {"deceleration_time", "deceleration"}}};
/// These keys need an input.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kInputNeeds{
    {{"home", "home"},
     {"alarm", "alarm"},
     {"at_upper_limit", "upper_limit"},
     {"at_lower_limit", "lower_limit"}}};

void check_needs(const YamlFields& fields, world::Diagnostics& diagnostics) {
  for (const Need& need : kNeeds) {
    const auto field = fields.find(need.key);
    if (!field || fields.has(need.needed) || (!need.instead.empty() && fields.has(need.instead))) continue;
    diagnostics.attempt(
        [&] { field->fail("has no effect without `" + std::string(need.needed) + "`; expected both"); });
  }
  for (const auto& [key, other] : kEither) {
    if (!fields.has(key) || !fields.has(other)) continue;
    diagnostics.attempt([&, &first = key, &second = other] {
      fields.at(first).fail("cannot be combined with `" + std::string(second) + "`; expected one of the two");
    });
  }
  const auto inputs = fields.find("inputs");
  for (const auto& [key, input] : kInputNeeds) {
    if (!fields.has(key) || (inputs && inputs->has(input))) continue;
    diagnostics.attempt([&, &of = key, &needed = input] {
      fields.at(of).fail("needs a switch; expected `inputs: { " + std::string(needed) + ": ... }`");
    });
  }
}

}  // namespace

AxisBinding read_axis(const YamlFields& fields, const std::string& name, const Description& description,
                      Binder& binder, world::Diagnostics& diagnostics) {
  AxisBinding axis{.name = name};
  if (!fields.is_map()) fields.fail("expected a map, as in `key: value`");
  diagnostics.attempt([&] { fields.require_keys(kAxisKeys); });
  const auto read = [&](std::string_view key, const auto& how) {
    diagnostics.attempt([&] {
      if (const auto field = fields.find(key)) how(*field);
    });
  };
  for (std::size_t i = 0; i < models::imported::kNumbers; ++i) {
    const auto number = static_cast<Number>(i);
    read(key_of(number), [&](const YamlFields& field) {
      axis.numbers[i] = is_time(number) ? binder.time(field) : binder.quantity(field);
    });
  }
  for (std::size_t i = 0; i < models::imported::kCommands; ++i) {
    read(key_of(static_cast<Command>(i)), [&](const YamlFields& field) {
      const bool is_level = models::imported::is_level(static_cast<Command>(i));
      axis.commands[i] = is_level ? binder.level(field) : binder.command(field);
    });
  }
  for (std::size_t i = 0; i < models::imported::kViews; ++i) {
    const auto view = static_cast<View>(i);
    const std::string what = name + "." + std::string(key_of(view));
    read(key_of(view), [&](const YamlFields& field) {
      axis.views[i] = binder.shown(field, field.text(), is_flag(view), what, view == View::position);
    });
  }
  read("pulses_per_count", [&](const YamlFields& field) { axis.pulses_per_count = read_scale(field); });
  read("pps_per_count", [&](const YamlFields& field) { axis.pps_per_count = read_factor(field); });
  read("inputs", [&](const YamlFields& inputs) {
    diagnostics.attempt([&] { inputs.require_keys(kAxisInputKeys); });
    const std::array<std::pair<std::string_view, int*>, 4> all{{{"upper_limit", &axis.upper_limit_input},
                                                                {"lower_limit", &axis.lower_limit_input},
                                                                {"home", &axis.home_input},
                                                                {"alarm", &axis.alarm_input}}};
    for (const auto& [key, input] : all) {
      diagnostics.attempt([&, &called = key, &number = input] {
        if (const auto field = inputs.find(called)) *number = read_input(*field, description);
      });
    }
  });
  read("home_way", [&](const YamlFields& field) {
    axis.home_direction = read_word(field, kDirectionSchema) == 0 ? -1 : +1;
  });
  read("home_position", [&](const YamlFields& field) { axis.home_position = field.integer(kCountsSchema); });
  read("pulses_per_revolution", [&](const YamlFields& field) {
    axis.pulses_per_revolution = static_cast<int>(field.integer(kPerRevolutionSchema));
  });
  read("while_busy", [&](const YamlFields& field) {
    axis.while_busy = static_cast<models::imported::WhileBusy>(read_word(field, kWhileBusySchema));
  });
  read("while_disabled", [&](const YamlFields& field) {
    axis.while_disabled =
        static_cast<models::imported::WhileDisabled>(read_word(field, kWhileDisabledSchema));
  });
  check_needs(fields, diagnostics);
  return axis;
}

}  // namespace understudy::emulator::model_file
