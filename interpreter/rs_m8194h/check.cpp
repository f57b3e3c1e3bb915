#include "interpreter/rs_m8194h/check.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/operators.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::interpreter::rs_m8194h {
namespace {

constexpr bool is_one_axis(std::int64_t mask) { return mask == 1 || mask == 2 || mask == 4 || mask == 8; }

std::size_t place_of(const CommandRow& row, std::string_view name) {
  for (std::size_t i = 0; i < row.parameter_count(); ++i) {
    if (row.parameters[i].name == name) return i;
  }
  return kMaxParameters;
}

/// Returns the parameter of the same command that decides whether another parameter is used, or nothing if it
/// is a variable.
std::optional<std::uint32_t> deciding(const Command& command, std::string_view name) {
  const std::size_t place = place_of(command.row(), name);
  if (is_reference(command, place)) return std::nullopt;
  return command.values[place];
}

/// Returns true if a segment of a mixed stream uses a point: lines have an end, circles have a centre, arcs
/// have both.
bool uses_point(const Command& command, std::string_view point) {
  const std::optional<std::uint32_t> shape = deciding(command, "nType");
  if (!shape) return false;
  return point.starts_with("cp") ? *shape != 1 : *shape <= 3;
}

bool is_axis_taken(const Command& command, std::size_t parameter) {
  for (std::size_t i = 0; i < parameter; ++i) {
    const Kind kind = command.row().parameters[i].kind;
    const bool is_axis = kind == Kind::axis || kind == Kind::axis_or_none;
    if (is_axis && command.values[i] == command.values[parameter]) return true;
  }
  return false;
}

bool is_axis_mask(const Command& command, const Parameter& row, std::int64_t mask, const Options& options) {
  const bool may_store =
      !command.is_macro_line() || options.chose(option("initial_in_macros", "stored_when_the_line_runs"));
  if (row.kind == Kind::setting_axes && may_store) return mask < 2 * kInitial && (mask & kAllAxes) != 0;
  if (command.verb() == Verb::line_scan && command.number(1) % 2 != 0) return mask == 1;  // odd: X alone
  return row.lists(mask);
}

bool is_good(const Command& command, std::size_t parameter, const Options& options) {
  const Parameter& row = command.row().parameters[parameter];
  if (is_reference(command, parameter)) return true;
  const std::int64_t value = command.number(parameter);
  switch (row.kind) {
    case Kind::axes:
    case Kind::setting_axes: return is_axis_mask(command, row, value, options);
    case Kind::axis: return is_one_axis(value) && !is_axis_taken(command, parameter);
    case Kind::axis_or_none: return value == 0 || (is_one_axis(value) && !is_axis_taken(command, parameter));
    case Kind::isr_if_used: return deciding(command, "nINT") != 1 || row.lists(value);
    case Kind::point_if_used: return !uses_point(command, row.name) || row.lists(value);
    case Kind::arithmetic:
    case Kind::comparison: return true;
    case Kind::operand:
    case Kind::variable:
      if (command.verb() == Verb::var_calculate) return true;
      [[fallthrough]];
    case Kind::number:
    case Kind::speed:
    case Kind::any_value:
    case Kind::byte_variable:
    case Kind::memory: return row.lists(value);
  }
  return false;
}

/// Returns the index of a rectangle's radius if it exceeds half a side.
std::optional<std::size_t> bad_radius(const Command& command) {
  const std::size_t radius = place_of(command.row(), "Rp");
  if (is_reference(command, radius)) return std::nullopt;
  for (const std::size_t side : {place_of(command.row(), "Lp"), place_of(command.row(), "Wp")}) {
    if (!is_reference(command, side) && 2 * command.number(radius) > command.number(side)) return radius;
  }
  return std::nullopt;
}

/// Limits that the manual prints as numbers, independent of MAX_V (3.4, 3.17, 7.1). Elsewhere, the device
/// clamps the values.
struct SpeedEnds {
  Verb verb;
  std::int64_t min;
  std::int64_t max;
};
constexpr std::int64_t kMaxSpeed = 4'000'000;
constexpr std::int64_t kMaxSlope = kMaxSpeed * 125;
constexpr SpeedEnds kSpeedEnds[] = {
    {Verb::set_max_v, 8'000, kMaxSpeed},
    {Verb::exd_cp, 0, kMax},
    {Verb::set_hv, 0, kMaxSpeed},
    {Verb::set_sv, 0, kMaxSpeed},
    {Verb::set_v, 0, kMaxSpeed},
    {Verb::change_vel_on_fly, 0, kMaxSpeed},
    {Verb::continue_move, -kMaxSpeed, kMaxSpeed},
    {Verb::set_a, 8'000 / 64, kMaxSlope},
    {Verb::set_d, 8'000 / 64, kMaxSlope},
    {Verb::set_k, 96, kMax},  // 8,000 x 0.0119211
    {Verb::set_l, 96, kMax},
    {Verb::set_vsv, 0, kMaxSpeed},
    {Verb::set_vv, 0, kMaxSpeed},
    {Verb::set_va, 8'000 / 64, kMaxSlope},
    {Verb::set_vd, 8'000 / 64, kMaxSlope},
    {Verb::set_vk, 96, kMax},
    {Verb::set_vl, 96, kMax},
};

std::optional<std::size_t> beyond_ends(const Command& command, std::size_t parameter, std::int64_t min,
                                       std::int64_t max) {
  const std::int64_t value = command.number(parameter);
  if (is_reference(command, parameter) || (value >= min && value <= max)) return std::nullopt;
  return parameter;
}

/// Commands whose sections state that a variable may replace a constant (5.2.1, 9.3 to 9.8).
constexpr Verb kSayReferences[] = {Verb::frnet_out, Verb::set_var, Verb::var_calculate,
                                   Verb::for_,      Verb::if_,     Verb::timer};

std::optional<std::size_t> first_reference(const Command& command) {
  for (std::size_t i = 0; i < command.row().parameter_count(); ++i) {
    if (is_reference(command, i)) return i;
  }
  return std::nullopt;
}

/// Returns the first parameter that only some options refuse.
std::optional<std::size_t> bad_by_choice(const Command& command, const Options& options) {
  const Verb verb = command.verb();
  if (options.chose(option("speed_ends", "exception_3"))) {
    for (const SpeedEnds& ends : kSpeedEnds) {
      if (ends.verb != verb) continue;
      return beyond_ends(command, command.row().parameter_count() - 1, ends.min, ends.max);
    }
  }
  if (options.chose(option("references", "exception_3")) &&
      std::ranges::find(kSayReferences, verb) == std::end(kSayReferences)) {
    if (const auto reference = first_reference(command)) return reference;
  }
  if (options.chose(option("rectangle_ends", "200000000")) && verb == Verb::rectangle) {
    constexpr std::int64_t kEarlierEnd = 200'000'000;
    for (const std::string_view name : {"Lp", "Wp", "Rp"}) {
      if (const auto beyond = beyond_ends(command, place_of(command.row(), name), 1, kEarlierEnd))
        return beyond;
    }
  }
  if (options.chose(option("variable_range", "exception_3")) && verb == Verb::write_var)
    return beyond_ends(command, 1, kMin, kMax);
  if (options.chose(option("zero_move", "exception_3")) && verb == Verb::fixed_move && command.number(1) == 0)
    return 1;
  if (options.chose(option("helix_cycle", "exception_3")) && verb == Verb::helix_3d) {
    return beyond_ends(command, place_of(command.row(), "cycle"), 0, kMax);
  }
  if (options.chose(option("helix_cycle_0", "exception_3")) && verb == Verb::helix_3d) {
    const std::size_t cycle = place_of(command.row(), "cycle");
    if (command.number(cycle) == 0 && !is_reference(command, cycle)) return cycle;
  }
  if (options.chose(option("several_trigger_axes", "exception_3")) && verb == Verb::sync_action &&
      !is_one_axis(command.number(0)))
    return 0;
  if (options.chose(option("set_out_of_z_and_u", "exception_3")) && verb == Verb::set_out &&
      command.number(0) > 3)
    return 0;
  return std::nullopt;
}

/// Returns true if a rectangle whose corners do not fit its sides is refused here. Otherwise, the machine
/// that executes it decides.
bool corners_must_fit(const Options& options) {
  return options.chose(option("rectangle_radius", "exception_3")) &&
         options.chose(option("rectangle_sides", "outer_length_and_width"));
}

}  // namespace

std::optional<std::size_t> bad_parameter(const Command& command, const Options& options) {
  const std::size_t count = command.row().parameter_count();
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_scan_type = command.verb() == Verb::line_scan_start && i == 1;
    if (is_scan_type && options.chose(option("uneven_scan_start", "starts_all_the_same")) &&
        command.number(i) <= 3)
      continue;
    if (!is_good(command, i, options)) return i;
  }
  if (command.verb() == Verb::rectangle && corners_must_fit(options)) {
    if (const auto radius = bad_radius(command)) return radius;
  }
  return bad_by_choice(command, options);
}

std::optional<std::size_t> bad_operand(const Command& command) {
  if (command.verb() != Verb::if_ && command.verb() != Verb::var_calculate) return std::nullopt;
  const CommandRow& row = command.row();
  for (std::size_t i = 0; i < row.parameter_count(); ++i) {
    const bool is_sound = row.parameters[i].kind == Kind::arithmetic ? is_arithmetic(command.values[i])
                          : row.parameters[i].kind == Kind::comparison
                              ? find_comparison(command.values[i]) != nullptr
                              : is_reference(command, i) || row.parameters[i].lists(command.number(i));
    if (!is_sound) return i;
  }
  return std::nullopt;
}

Fault operand_fault(const Command& command) {
  if (!bad_operand(command)) return Fault::none;
  return command.verb() == Verb::if_ ? Fault::comparison : Fault::operand;
}

std::string expected_of(const Command& command, std::size_t parameter) {
  const Parameter& row = command.row().parameters[parameter];
  const std::string or_variable = !command.is_macro_line() || row.reference == Reference::none ? ""
                                  : row.reference == Reference::variable ? ", or VAR0 to VAR511"
                                                                         : ", or bVAR0 to bVAR127";
  switch (row.kind) {
    case Kind::axes:
      if (row.max < 3) return "X or Y";
      return row.max == 3 ? "X, Y or XY" : "axes, X to XYZU";
    case Kind::setting_axes:
      return command.is_macro_line() ? "axes, X to XYZU" : "axes, X to XYZU, or INITIAL_X to INITIAL_XYZU";
    case Kind::axis: return "X, Y, Z or U, each at most once";
    case Kind::axis_or_none: return "X, Y, Z, U or 0, each at most once";
    case Kind::variable: return "VAR0 to VAR511";
    case Kind::byte_variable: return "bVAR0 to bVAR127";
    case Kind::memory: return "MD0 to MD2047";
    case Kind::arithmetic: return "one of + - * / & |";
    case Kind::comparison: return "one of < <= > >= == !=";
    case Kind::number:
    case Kind::speed:
    case Kind::any_value:
    case Kind::operand:
    case Kind::isr_if_used:
    case Kind::point_if_used: break;
  }
  if (row.width == Width::real) return "a real number";
  // The radius itself is in range, but it does not fit the sides.
  const bool is_radius = command.verb() == Verb::rectangle && row.name == "Rp";
  if (is_radius && row.lists(command.number(parameter)) && bad_radius(command)) {
    return "at most half of Lp and of Wp";
  }
  if (row.only == 0) return std::to_string(row.min) + " to " + std::to_string(row.max) + or_variable;
  std::string list;
  for (std::int64_t value = row.min; value <= row.max; ++value) {
    if (row.lists(value)) list += (list.empty() ? "" : ", ") + std::to_string(value);
  }
  return "one of " + list + or_variable;
}

}  // namespace understudy::interpreter::rs_m8194h
