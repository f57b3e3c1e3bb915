// Any text as a listing of a SUPER-40NC's programs is refused with places, or it is a set of programs: then
// the listing made from them gives the same programs, and they run for a while, all six at once.
#include <cstdint>
#include <string>

#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/step_programs.h"
#include "tests/fuzz/fuzzing.h"
#include "tests/interpreter/super_40nc/plain_machine.h"

namespace {

using namespace understudy;
using namespace understudy::interpreter::super_40nc;
using fuzzing::require;

constexpr std::size_t kLongest = 8192;
constexpr int kTicks = 40;

void run_all(const Program& program) {
  static PlainMachine machine;
  machine.memory = {};
  machine.contacts = {};
  machine.registers = {};
  machine.set_special_register(named::kOwnedAxes, 2);
  const Options options;
  Ladder ladder;
  if (const auto& plc_program = program.area(Area::plc))
    ladder = Ladder(*plc_program, machine.layout(), options);
  StepCodes codes;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (program.areas.at(i)) codes.at(i) = StepCode(*program.areas.at(i));
  }
  PlcState plc;
  StepStates states;
  StepPrograms steps(states, codes, machine, options);
  interpreter::super_40nc::run(plc, ladder, machine);
  for (int i = 0; i < kStepProgramCount; ++i) steps.take(Event::start, static_cast<Area>(i));
  for (int tick = 0; tick < kTicks; ++tick) {
    machine.memory.at(static_cast<std::size_t>(tick) % 24) ^= 1;
    const Scanned scanned = scan(plc, ladder, machine, steps, options);
    require(!scanned.has_changed || scanned.quiet_scans == 0, "a scan that changes something is not quiet");
    steps.run_slices();
    for (int i = 0; i < kStepProgramCount; ++i) {
      require(steps.quiet_ms(static_cast<Area>(i)) >= 0, "a quiet time is not negative");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kLongest) return 0;
  const Checked checked = check(fuzzing::text_of(data, size));
  require(checked.program.has_value() == checked.errors.empty(), "programs or errors");
  for (const Diagnostic& error : checked.errors) {
    require(error.line >= 1 && error.column >= 1, "an error has its place");
    require(!error.what.empty() && error.code != Code::none, "an error says something");
  }
  if (!checked.program) return 0;
  const std::string text = list(*checked.program);
  const Checked again = check(text);
  require(again.program == checked.program, "a listing made from programs is those programs");
  require(list(*again.program) == text, "and is the same again");
  run_all(*checked.program);
  return 0;
}
