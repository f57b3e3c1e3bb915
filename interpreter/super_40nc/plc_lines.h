// The PLC instructions that are not decoded into small steps: rare outputs, data instructions that act on the
// device, and motion that depends on a level or an edge.
#pragma once

#include "interpreter/super_40nc/access.h"
#include "interpreter/super_40nc/plc.h"

namespace understudy::interpreter::super_40nc {

/// Returns true if an instruction reacts to the edge of its condition only because of a choice.
inline bool needs_edge(Op op, const Options& options) {
  const bool is_mode = op == Op::absc || op == Op::incc || op == Op::rpm || op == Op::pset || op == Op::mset;
  return options.chose(option("instruction_edges", "all_on_the_edge")) && (is_mode || op == Op::stp);
}

class PlcLines {
 public:
  PlcLines(PlcState& plc, const Ladder& ladder, Machine& machine, StepControl& programs,
           const Options& options)
      : plc_(plc), ladder_(ladder), access_(machine), programs_(programs), options_(options) {}

  /// Returns true if anything has changed.
  bool carry_out(const LadderStep& step, bool is_on);
  bool end_scan();

 private:
  bool count_as_edge(const LadderStep& step, bool is_on, bool& fires);
  bool begin_motion(const Instruction& line, int step);
  bool set_modes(const Instruction& line);
  void jog(const Instruction& line, int step);
  void control_programs(const Instruction& line);
  AxisValues movable(AxisValues values, int step);
  bool report(Code code, int step) {
    access_.machine().report(code, Area::plc, step);
    return true;
  }

  PlcState& plc_;
  const Ladder& ladder_;
  Access access_;
  StepControl& programs_;
  const Options& options_;
  Jogs jogs_;
  JogSteps jog_steps_{};
};

}  // namespace understudy::interpreter::super_40nc
