#include "emulator/play/reading/step_rows.h"

#include <array>
#include <span>

#include "emulator/play/reading/step_forms.h"
#include "emulator/play/reading/step_readers.h"
#include "emulator/world/bench_file/form.h"

namespace understudy::emulator::play {

std::span<const StepRow> step_rows() {
  static constexpr std::array kRows{
      // Over the line.
      StepRow{{"write", "Writes registers over the line, in this order.", &world::kTextByRegister},
              read_write,
              kAnswerKeys},
      StepRow{{"command", "Sends commands by name through the window of a device.", &world::kTextByDevice},
              read_command,
              kAnswerKeys},
      StepRow{{"expect", "Reads registers over the line and compares.", &world::kTextByRegister},
              read_expect,
              kAnswerKeys},
      StepRow{{"send", "Sends bytes as they are, or a line of text, and compares the reply.", &kSendForm},
              read_send},
      StepRow{{"hear", "Hears lines that a device sends unasked.", &kHearForm}, read_hear},
      // Time and truth.
      StepRow{{"wait", "Waits until a condition holds.", &kWaitForm}, read_wait},
      StepRow{{"advance", "Lets simulated time pass.", &world::kDuration}, read_advance},
      StepRow{{"assert", "What must be true now, without the line.", &kAssertForm}, read_assert},
      StepRow{{"always", "What must be true in every tick from now on.", &kSpanForm},
              read_always,
              {},
              StepRow::Names::gives},
      StepRow{{"never", "What must not be true in any tick from now on.", &kSpanForm},
              read_never,
              {},
              StepRow::Names::gives},
      StepRow{{"end", "Ends an `always` or `never`.", &world::kText}, read_end, {}, StepRow::Names::wants},
      StepRow{{"reset", "Starts counting the greatest speeds and accelerations anew.", &kResetForm},
              read_reset},
      StepRow{{"say", "A sentence for whoever reads along.", &world::kText}, read_say},
      // From outside.
      StepRow{{"input", "Sets inputs, analog inputs and switches on the housing.", &world::kTextByInput},
              read_inputs},
      StepRow{
          {"turn", "Turns hand wheels and what else is counted, so far, `in` a time.", &world::kTextByTurned},
          read_turn},
      StepRow{{"inject", "Breaks something.", &kInjectForm}, read_inject, {}, StepRow::Names::gives},
      StepRow{{"clear", "Mends it: the fault's name, or `all`.", &world::kText},
              read_clear,
              {},
              StepRow::Names::wants},
      StepRow{{"power", "Switches devices on, off, or off and on again.", &kPowerForm}, read_power},
      StepRow{{"program", "Loads a program into a device.", &world::kTextByDevice},
              read_program,
              kProgramBesideKeys},
      StepRow{{"memory", "A device's non-volatile memory must be what the file says.", &world::kTextByDevice},
              read_memory,
              {},
              StepRow::Names::wants},
      StepRow{{"save", "Writes a device's non-volatile memory to a file.", &world::kTextByDevice},
              read_save,
              {},
              StepRow::Names::gives},
      // The course of things.
      StepRow{{"snapshot", "Keeps the state under this name.", &world::kText},
              read_snapshot,
              {},
              StepRow::Names::gives},
      StepRow{{"restore", "Goes back to the state of that name.", &world::kText},
              read_restore,
              {},
              StepRow::Names::wants},
      StepRow{{"fork", "Continuations, by name, that all begin here.", &kForkForm},
              read_fork,
              {},
              StepRow::Names::gives},
      StepRow{
          {"repeat", "The same steps several times.", &kRepeatForm}, read_repeat, {}, StepRow::Names::gives},
      StepRow{
          {"for", "The same steps for each of some values.", &kForForm}, read_for, {}, StepRow::Names::gives},
      StepRow{
          {"include", "The steps of another file.", &world::kText}, read_include, {}, StepRow::Names::gives},
  };
  return kRows;
}

}  // namespace understudy::emulator::play
