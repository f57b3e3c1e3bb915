// The error that D8094 to D8096 show.
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/step_programs.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

Code code_of(motion::Cause why) {
  switch (why) {
    case motion::Cause::limit_plus: return Code::limit_positive;
    case motion::Cause::limit_minus: return Code::limit_negative;
    case motion::Cause::soft_limit_plus: return Code::soft_limit_positive;
    case motion::Cause::soft_limit_minus: return Code::soft_limit_negative;
    case motion::Cause::alarm: return Code::alarm;
    case motion::Cause::comparator: return Code::comparator;
    case motion::Cause::homing_failed: return Code::home_failed;
    case motion::Cause::none:
    case motion::Cause::arrived:
    case motion::Cause::stopped:
    case motion::Cause::emergency:
    case motion::Cause::servo_off: break;
  }
  return Code::none;
}

void Ground::report(const ErrorReport& error) {
  if (error.code == Code::none || (state_.error.code != Code::none && state_.error.tick == now())) return;
  decisions().meet(kErrorTable, static_cast<std::size_t>(error.code) - 1, error.area == Area::plc ? 0 : 1);
  state_.error = error;
  state_.error.tick = now();
}

void Ground::report(Code code, Mover of_its_line) {
  ErrorReport error{.code = code, .step = line_step(of_its_line)};
  if (of_its_line < Mover::plc) {
    const auto area = static_cast<Area>(of_its_line);
    const bool runs = steps_.programs[interpreter::super_40nc::index_of(area)].phase !=
                      interpreter::super_40nc::Phase::idle;
    if (runs) error.area = area;
  }
  report(error);
}

/// Called when a program has started, or a motion by hand or by the PLC.
void Ground::error_is_over() {
  if (!chose(option("error_clears", "plc_to_run_alone"))) clear_error();
}

int Ground::line_step(Mover mover) const {
  if (mover >= Mover::plc) return mover == Mover::plc ? plc_step_ : 0;
  const auto area = static_cast<interpreter::super_40nc::Area>(mover);
  const interpreter::super_40nc::StepState& program =
      steps_.programs[interpreter::super_40nc::index_of(area)];
  return program.phase == interpreter::super_40nc::Phase::idle
             ? 0
             : interpreter::super_40nc::base_of(area, options_) + program.step;
}

}  // namespace understudy::emulator::models::super_40nc
