#include "emulator/play/reading/step_rows.h"

#include <array>
#include <span>

#include "emulator/play/reading/step_readers.h"
#include "emulator/play/reading/step_schemas.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::play {

namespace {

constexpr std::array kStepRows{
    // These steps use the line.
    StepRow{{"write", "Writes registers over the line, in this order.", &world::kTextByRegister},
            read_write,
            kAnswerKeys},
    StepRow{{"command", "Sends commands by name through the window of a device.", &world::kTextByDevice},
            read_command,
            kAnswerKeys},
    StepRow{{"expect", "Reads registers over the line and compares them with the expected values.",
             &world::kTextByRegister},
            read_expect,
            kAnswerKeys},
    StepRow{{"send", "Sends bytes as they are, or a line of text, and compares the reply.", &kSendSchema},
            read_send},
    StepRow{{"hear", "Expects lines that a device sends without a request.", &kHearSchema}, read_hear},
    // In these steps time passes, or they check values without using the line.
    StepRow{{"wait", "Waits until a condition holds.", &kWaitSchema}, read_wait},
    StepRow{{"advance", "Advances simulated time.", &world::kDuration}, read_advance},
    StepRow{{"assert", "A condition that must be true now; does not use the line.", &kAssertSchema},
            read_assert},
    StepRow{{"always", "A condition that must be true at every tick from now on.", &kSpanSchema},
            read_always,
            {},
            StepRow::Names::gives},
    StepRow{{"never", "A condition that must not be true at any tick from now on.", &kSpanSchema},
            read_never,
            {},
            StepRow::Names::gives},
    StepRow{{"end", "Ends an `always` or `never`.", &world::kText}, read_end, {}, StepRow::Names::wants},
    StepRow{{"reset", "Restarts the measurement of peak speeds and accelerations.", &kResetSchema},
            read_reset},
    StepRow{
        {"host", "Waits for the end of the command of `exec`; `stop` asks it to end first.", &kHostSchema},
        read_host},
    StepRow{{"say", "A sentence for the reader.", &world::kText}, read_say},
    // These steps act from outside.
    StepRow{{"input", "Sets inputs, analog inputs and switches on the housing.", &world::kTextByInput},
            read_inputs},
    StepRow{{"turn", "Turns hand wheels and other counted inputs by these counts, `in` a duration.",
             &world::kTextByTurned},
            read_turn},
    StepRow{{"inject", "Injects a fault.", &kInjectSchema}, read_inject, {}, StepRow::Names::gives},
    StepRow{{"clear", "Clears a fault: its name, or `all`.", &world::kText},
            read_clear,
            {},
            StepRow::Names::wants},
    StepRow{{"power", "Switches devices on, off, or off and on again.", &kPowerSchema}, read_power},
    StepRow{{"program", "Loads a program into a device.", &world::kTextByDevice},
            read_program,
            kProgramBesideKeys},
    StepRow{{"memory", "A device's non-volatile memory must match the file.", &world::kTextByDevice},
            read_memory,
            {},
            StepRow::Names::wants},
    StepRow{{"save", "Writes a device's non-volatile memory to a file.", &world::kTextByDevice},
            read_save,
            {},
            StepRow::Names::gives},
    // These steps control the order of other steps.
    StepRow{{"snapshot", "Saves the state under this name.", &world::kText},
            read_snapshot,
            {},
            StepRow::Names::gives},
    StepRow{{"restore", "Restores the state of that name.", &world::kText},
            read_restore,
            {},
            StepRow::Names::wants},
    StepRow{{"fork", "Branches, by name, that all start from this state.", &kForkSchema},
            read_fork,
            {},
            StepRow::Names::gives},
    StepRow{{"repeat", "Runs the same steps several times.", &kRepeatSchema},
            read_repeat,
            {},
            StepRow::Names::gives},
    StepRow{{"for", "Runs the same steps for each value.", &kForSchema}, read_for, {}, StepRow::Names::gives},
    StepRow{{"include", "Runs the steps of another file.", &world::kText},
            read_include,
            {},
            StepRow::Names::gives},
};

}  // namespace

std::span<const StepRow> step_rows() { return kStepRows; }

}  // namespace understudy::emulator::play
