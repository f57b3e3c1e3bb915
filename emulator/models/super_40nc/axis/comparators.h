// The five comparators of each axis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "emulator/models/super_40nc/axis/chips.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

/// The stop that a comparator requests when it is checked at the end of a tick.
struct ComparatorStop {
  bool by_ramp = false;
  motion::Cause why = motion::Cause::none;
};

class Comparators : protected Chips {
 public:
  explicit Comparators(const Chips& chips) : Chips(chips) {}

  bool comparator_holds(int axis, int number) const;
  /// Sets the chip's comparators from the registers.
  void set_comparators(int axis_number);
  /// Checks one comparator at the end of a tick. Returns the stop that it requests.
  std::optional<ComparatorStop> compare(int axis_number, std::size_t which);

 private:
  std::int64_t compared_number(int axis, std::size_t which) const;
  std::optional<motion::Comparator> comparator_of(int axis, std::size_t which) const;
  void set_comparator(int axis, std::size_t place, motion::Comparator wanted);
  void see_counters(int axis_number);
};

}  // namespace understudy::emulator::models::super_40nc
