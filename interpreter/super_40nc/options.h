// The selected options for the languages. The interpreter looks them up through this header.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/choices.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/choices.h"

namespace understudy::interpreter::super_40nc {

struct Options : OptionsOf<kChoices> {
  using OptionsOf::OptionsOf;

  int c_capacity = 1500;  // D9042: the capacity of C and of each file
};

consteval Options::Named option(std::string_view id, std::string_view name) {
  return Options::named(id, name);
}

/// Returns the depth of the block stack, which is also that of the branch stack.
inline int stack_depth(const Options& options) {
  if (options.chose(option("stack_depth", "8"))) return 8;
  return options.chose(option("stack_depth", "11")) ? 11 : 16;
}

inline int if_depth(const Options& options) { return options.chose(option("if_depth", "1")) ? 1 : 8; }
inline int call_depth(const Options& options) { return options.chose(option("cal_depth", "8")) ? 8 : 16; }

/// Returns how many instructions of a step program run in a tick.
inline int slice(const Options& options) { return options.chose(option("slice_length", "1_line")) ? 1 : 64; }

/// Returns the time between scans in milliseconds.
inline int scan_ms(const Options& options) {
  if (options.chose(option("scan_time", "2_ms"))) return 2;
  return options.chose(option("scan_time", "5_ms")) ? 5 : 1;
}

inline int timer_unit_ms(const Options& options) {
  if (options.chose(option("timer_unit", "10ms"))) return 10;
  return options.chose(option("timer_unit", "1s")) ? 1000 : 1;
}

/// Returns true if the field of RPM changes the speed of the axis.
inline bool sets_speed(const std::optional<std::int32_t>& rpm, const Options& options) {
  return rpm && (*rpm > 0 || !options.chose(option("rpm_not_positive", "keeps_the_speed")));
}

/// Returns the number of an area's first step in D8095 and D8096.
inline int base_of(Area area, const Options& options) {
  if (options.chose(option("area_bases", "each_from_0"))) return 0;
  return options.chose(option("area_bases", "newer")) ? row_of(area).base : row_of(area).older_base;
}

}  // namespace understudy::interpreter::super_40nc
