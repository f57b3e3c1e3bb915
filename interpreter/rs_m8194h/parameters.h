// Functions that define the parameters of the rows of the command table.
#pragma once

#include <cstdint>
#include <string_view>

#include "interpreter/rs_m8194h/command_row.h"

namespace understudy::interpreter::rs_m8194h::rows {

constexpr Parameter axes(std::string_view name) {
  return {.name = name, .kind = Kind::axes, .min = 1, .max = kAllAxes};
}
inline constexpr Parameter kSettingAxes = {
    .name = "axis", .kind = Kind::setting_axes, .min = 1, .max = kAllAxes};
constexpr Parameter axes_up_to(std::string_view name, std::int64_t max) {
  return {.name = name, .kind = Kind::axes, .min = 1, .max = max};
}
constexpr Parameter one_axis(std::string_view name) {
  return {.name = name, .kind = Kind::axis, .min = 1, .max = 8};
}
constexpr Parameter axis_or_none(std::string_view name) {
  return {.name = name, .kind = Kind::axis_or_none, .min = 0, .max = 8};
}

/// A byte whose constants are below 0x80, so that bVARn can replace it in a macro.
constexpr Parameter byte(std::string_view name, std::int64_t min, std::int64_t max,
                         std::string_view values = {}) {
  return {.name = name, .min = min, .max = max, .reference = Reference::byte_variable, .values = values};
}
constexpr Parameter byte_of(std::string_view name, std::uint32_t only, std::string_view values = {}) {
  return {.name = name,
          .min = 0,
          .max = 31,
          .only = only,
          .reference = Reference::byte_variable,
          .values = values};
}
/// A byte that is checked when a macro is stored, and that a variable cannot replace.
constexpr Parameter constant_byte(std::string_view name, std::int64_t min, std::int64_t max) {
  return {.name = name, .min = min, .max = max};
}
constexpr Parameter any_byte(std::string_view name) {
  return {.name = name, .kind = Kind::any_value, .min = 0, .max = 0xFFFF};
}
constexpr Parameter any_isr(std::string_view name) {
  return {.name = name,
          .kind = Kind::isr_if_used,
          .min = 0,
          .max = kIsrCount,
          .reference = Reference::byte_variable};
}

constexpr Parameter unsigned_range(std::string_view name, std::int64_t min, std::int64_t max,
                                   std::string_view values = {}) {
  return {.name = name,
          .width = Width::unsigned_long,
          .min = min,
          .max = max,
          .reference = Reference::variable,
          .values = values};
}
constexpr Parameter long_range(std::string_view name, std::int64_t min, std::int64_t max) {
  return {
      .name = name, .width = Width::signed_long, .min = min, .max = max, .reference = Reference::variable};
}
constexpr Parameter position(std::string_view name) { return long_range(name, kMin, kMax); }
constexpr Parameter point(std::string_view name) {
  Parameter parameter = position(name);
  parameter.kind = Kind::point_if_used;
  return parameter;
}
constexpr Parameter speed(std::string_view name) {
  return {.name = name,
          .kind = Kind::speed,
          .width = Width::unsigned_long,
          .min = 0,
          .max = UINT32_MAX,
          .reference = Reference::variable};
}
constexpr Parameter signed_speed(std::string_view name) {
  return {.name = name,
          .kind = Kind::speed,
          .width = Width::signed_long,
          .min = INT32_MIN,
          .max = INT32_MAX,
          .reference = Reference::variable};
}
constexpr Parameter any_long(std::string_view name) {
  return {
      .name = name, .kind = Kind::any_value, .width = Width::signed_long, .min = INT32_MIN, .max = INT32_MAX};
}
constexpr Parameter any_real(std::string_view name) {
  return {.name = name, .kind = Kind::any_value, .width = Width::real, .min = 0, .max = UINT32_MAX};
}

constexpr Parameter variable(std::string_view name) {
  return {.name = name,
          .kind = Kind::variable,
          .width = Width::signed_long,
          .min = kVariable0,
          .max = kVariable0 + kVariableCount - 1};
}
constexpr Parameter byte_variable(std::string_view name) {
  return {.name = name,
          .kind = Kind::byte_variable,
          .min = kByteVariable0,
          .max = kByteVariable0 + kByteVariableCount - 1};
}
constexpr Parameter memory(std::string_view name) {
  return {.name = name, .kind = Kind::memory, .width = Width::signed_long, .min = 0, .max = kMemoryCount - 1};
}
constexpr Parameter operand(std::string_view name) {
  Parameter parameter = position(name);
  parameter.kind = Kind::operand;
  return parameter;
}
constexpr Parameter arithmetic(std::string_view name) {
  return {.name = name, .kind = Kind::arithmetic, .min = 0, .max = 0x7F, .values = "+ - * / & |"};
}
constexpr Parameter comparison(std::string_view name) {
  return {.name = name, .kind = Kind::comparison, .min = 0, .max = 0xFFFF, .values = "< <= > >= == !="};
}

/// The uses of a function.
inline constexpr Use kAtOnce = {.real_time = RealTime::immediate};
inline constexpr Use kDownload = {.real_time = RealTime::immediate, .refused_while_mp_runs = true};
inline constexpr Use kStop = {.real_time = RealTime::stop, .in_mp = true};
inline constexpr Use kQueued = {.real_time = RealTime::queued};
inline constexpr Use kQueuedDrive = {.real_time = RealTime::queued, .starts_motion = true};
inline constexpr Use kQueuedUnlessMp = {.real_time = RealTime::queued, .refused_while_mp_runs = true};
inline constexpr Use kSetting = {.real_time = RealTime::queued, .in_mp = true, .initial = true};
inline constexpr Use kNotInIsr = {.real_time = RealTime::queued, .in_mp = true};
inline constexpr Use kDriveNotInIsr = {.real_time = RealTime::queued, .in_mp = true, .starts_motion = true};
inline constexpr Use kCall = {.real_time = RealTime::queued, .in_mp = true, .refused_while_mp_runs = true};
inline constexpr Use kEverywhere = {.real_time = RealTime::queued, .in_mp = true, .in_isr = true};
inline constexpr Use kDrive = {
    .real_time = RealTime::queued, .in_mp = true, .in_isr = true, .starts_motion = true};
inline constexpr Use kTerminate = {.real_time = RealTime::immediate, .in_mp = true, .in_isr = true};
inline constexpr Use kMacro = {.in_mp = true, .in_isr = true};
inline constexpr Use kMpOnly = {.in_mp = true};
inline constexpr Use kIsrOnly = {.in_isr = true};

}  // namespace understudy::interpreter::rs_m8194h::rows
