// Runs a listing on a scripted machine: in each tick the PLC, then the step programs, then motion.
#pragma once

#include <string>
#include <string_view>

#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/step_programs.h"
#include "tests/interpreter/super_40nc/scripted_machine.h"

namespace understudy::interpreter::super_40nc {

inline Program program_of(std::string_view text, const Options& options = {}) {
  const Checked checked = check(text, options);
  std::string errors;
  for (const Diagnostic& error : checked.errors) errors += to_string(error) + '\n';
  EXPECT_EQ(errors, "") << text;
  return checked.program.value_or(Program{});
}

class Running {
 public:
  explicit Running(std::string_view text, const Options& with = {}) : options(with) {
    const Program program = program_of(text, options);
    if (const auto& plc_program = program.area(Area::plc)) {
      ladder = Ladder(*plc_program, machine.layout(), options);
    }
    for (std::size_t i = 0; i < codes.size(); ++i) {
      if (program.areas.at(i)) codes.at(i) = StepCode(*program.areas.at(i));
    }
  }

  StepPrograms programs() { return {steps, codes, machine, options}; }
  void run_plc() { super_40nc::run(plc, ladder, machine); }
  Scanned scan() {
    StepPrograms control = programs();
    return super_40nc::scan(plc, ladder, machine, control, options);
  }
  /// Runs ticks of the step programs and of motion.
  void tick(int count = 1) {
    for (int i = 0; i < count; ++i) {
      programs().run_slices();
      machine.move();
    }
  }
  void start(Area area) { programs().take(Event::start, area); }
  void take(Event event, Area area) { programs().take(event, area); }
  const StepState& state(Area area) const { return steps.programs.at(index_of(area)); }
  Phase phase(Area area) const { return state(area).phase; }

  Options options;
  ScriptedMachine machine;
  Ladder ladder;
  PlcState plc;
  StepCodes codes;
  StepStates steps;
};

}  // namespace understudy::interpreter::super_40nc
