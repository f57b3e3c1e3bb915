// A scenario is a bench with steps to run on it; both have been checked together. scenario_file.h creates it,
// and run.h runs it. Loops, tables of cases, includes and parameters have been resolved, so the steps are a
// plain list.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/scenario/case.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/expression/tolerance.h"
#include "emulator/world/faults/fault.h"

namespace understudy::emulator::play {

class HuntPlan;  // emulator/play/reading/hunt_plan.h

struct Step;
using Steps = std::vector<Step>;

/// A register or a bit as a host addresses it: by name (in this case, `place` is set), or by address in a
/// table.
struct Target {
  std::size_t device = 0;
  std::string name;  // as written in the file: "feeder.Cord_A", "feeder.0x1014"
  std::optional<NamedPlace> place{};
  Table table = Table::holding;  // only without `place`
  std::uint16_t address = 0;     // only without `place`: the number in `table`
  bool is_value = false;         // a value of a device without registers, read directly, not over the line
};

/// How a device must answer each request of a step: normally, with an exception, or not at all.
struct Answer {
  std::optional<int> exception{};
  std::optional<SimTime> silence{};  // the time within which no answer may arrive
  bool is_good() const { return !exception && !silence; }
};

/// The line on which a step communicates with its devices (`via: LINE` next to the step). No value: the first
/// line of each device.
using Via = std::optional<std::size_t>;

/// write: { feeder.Aaxis_Pulse: 32000, feeder.Aaxis_Move_INC: 1 } writes over the line in this order;
/// consecutive ascending registers are combined in one request. With exception: 3, the device must refuse;
/// with reply: nothing, it must not answer.
struct WriteStep {
  struct Entry {
    Target target;
    std::string value;  // an expression, evaluated when the step runs
  };
  std::vector<Entry> entries;
  Answer answer{};
  Via via{};
};

/// expect: { feeder.Cord_A: 32000, feeder.STATUS.4: 0 } reads over the line. exception and reply are as in
/// write.
struct ExpectStep {
  struct Entry {
    Target target;
    world::Tolerance value;
  };
  std::vector<Entry> entries;
  Answer answer{};
  Via via{};
};

/// command: { cell: "MOVE X 1000" } sends commands of the model through its window, one per request.
/// exception and reply are as in write.
struct CommandStep {
  struct Entry {
    std::size_t device = 0;
    std::string text;
  };
  std::vector<Entry> entries;
  Answer answer{};
  Via via{};
};

/// wait: { until: EXPRESSION, within: 4s, takes: 3050ms +- 2ms, poll: 20ms, via: rs485 }
struct WaitStep {
  std::string until;
  SimTime within{0};
  std::optional<world::Tolerance> takes;
  /// How often the names in `until` are read over the line. Without it, every tick is checked.
  std::optional<SimTime> poll;
  Via via{};  // the line on which these names are read
};

struct AdvanceStep {
  SimTime by{0};
};

/// assert: EXPRESSION, or a list of expressions: checks the present values without using the line.
struct AssertStep {
  std::vector<std::string> expressions;
};

/// always: or never: { what: EXPRESSION, name: NAME }, or only the expression. The expression is checked in
/// every tick from now on, until end: NAME or the end of the scenario.
struct SpanStep {
  std::string expression;
  bool never = false;
  std::string name;  // by default, the expression
};
struct EndSpanStep {
  std::string name;
};

/// input: { feeder.DIN_10: on, feeder.AIN_A: 2.5V }
struct InputStep {
  std::vector<world::InputSetup> inputs;
};

/// turn: { mill.MPG: 400, in: 2s } turns hand wheels and other counted inputs.
struct TurnStep {
  std::vector<world::Fault> turns;
};

/// inject: { stall: feeder.A, name: NAME }
struct InjectStep {
  world::Fault fault;
  std::string name;  // the name for `clear`; by default, the fault as text
};
/// clear: NAME, or all
struct ClearStep {
  std::string name;  // empty for all faults
};

/// power: { feeder: off }, on or cycle
struct PowerStep {
  enum class To : std::uint8_t { off, on, cycle };
  std::vector<std::pair<std::size_t, To>> devices;
};

/// send: { line: rs485, bytes: 01 03 00 01 00 01 D5 CA, reply: 01 03 02 C0 01 29 84, within: 100ms }. With
/// reply: nothing, no byte may arrive in that time. Without reply, any bytes are accepted.
struct SendStep {
  std::size_t line = 0;
  std::vector<std::uint8_t> bytes;
  std::optional<std::vector<std::uint8_t>> reply;  // empty: nothing may arrive
  SimTime within = std::chrono::milliseconds(500);
};

/// send: { line: serial, text: "?PE", reply: "100", within: 100ms } sends a line of text, which is written
/// without its line ending. reply is a line, a list of lines, or `nothing` if no line may arrive in that
/// time. Without reply, any answer is accepted. hear: { line: serial, text: "DONE", within: 2s } expects
/// lines that the device has sent without a request since the last `send`.
struct TextStep {
  std::size_t line = 0;
  std::optional<std::string> text;                // no value: the step only receives
  std::optional<std::vector<std::string>> lines;  // empty: nothing may arrive
  SimTime within = std::chrono::milliseconds(500);
};

/// program: { feeder: indexing.lst }
struct ProgramStep {
  std::size_t device = 0;
  std::string text;
  std::string file{};                         // for messages; empty if the text is in the step
  std::optional<world::InlineText> inside{};  // the place of the text, if it is in the step
  std::optional<std::string> refused{};       // the refusal must contain this text
  bool asks = true;  // true: the step fails if the program is refused; false: both outcomes are accepted
};

/// memory: { feeder: after.json }: the device's non-volatile memory must equal the file. save: writes the
/// file.
struct MemoryStep {
  enum class What : std::uint8_t { expect, save } what = What::expect;
  std::size_t device = 0;
  std::string file;
};

/// host: { exits: 0, within: 30s } waits for the end of the command that runs with the scenario. host: stop
/// first asks it to end, and accepts any exit code.
struct CommandEndStep {
  bool stops = false;
  int exits = 0;
  SimTime within{0};
};

/// snapshot: NAME and restore: NAME
struct SnapshotStep {
  std::string name;
};
struct RestoreStep {
  std::string name;
};

/// fork: { NAME: [ steps ], NAME: [ steps ] }: each branch starts in the present state. The steps after the
/// fork also continue from this state.
struct ForkStep {
  struct Branch {
    std::string name;
    Steps steps;
  };
  std::vector<Branch> branches;
};

/// reset: peaks restarts the maximum speeds and accelerations.
struct ResetPeaksStep {};

/// say: TEXT is a message for the reader.
struct SayStep {
  std::string text;
};

struct Step {
  std::string file;  // the place in a file
  int line = 0;
  std::string text;  // the description on one line: "write feeder.Aaxis_SVON=1"
  std::variant<WriteStep, CommandStep, ExpectStep, WaitStep, AdvanceStep, AssertStep, SpanStep, EndSpanStep,
               InputStep, TurnStep, InjectStep, ClearStep, PowerStep, SendStep, TextStep, ProgramStep,
               MemoryStep, CommandEndStep, SnapshotStep, RestoreStep, ForkStep, ResetPeaksStep, SayStep>
      what;
};

/// A case of a scenario file. A file with a table of cases creates one scenario for each row.
struct Scenario {
  std::string name;  // including the parameters of the case: "a move takes its time (speed=200)"
  std::string file;
  world::Bench bench;
  SimTime gap{0};  // added to t3.5 between two requests from the host
  std::uint64_t seed = 0;
  Steps steps;
  std::vector<FileClaim> files{};    // all files from which it was read, including those of the bench
  std::vector<std::string> saved{};  // paths that its steps write
  Case which{};
  std::string choice{};                // the id in `choice`; the option is the first value of the case
  std::vector<std::string> command{};  // the words of ReadingOptions::command, with the values of the case
  std::vector<std::pair<std::string, std::string>> environment{};  // for the command
  std::shared_ptr<const HuntPlan> hunt{};                          // null: the file has no `hunt`
};

}  // namespace understudy::emulator::play
