// A scenario: a bench and the steps of a play on it, checked against each other. Made by scenario_file.h,
// played by run.h. Loops, tables of cases, includes and parameters are gone by then: what is left is a
// list.
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

struct Step;
using Steps = std::vector<Step>;

/// A register or a bit as a host addresses it: by name (then `place` is set), or by its number in a table.
struct Target {
  std::size_t device = 0;
  std::string name;  // as written: "feeder.Cord_A", "feeder.0x1014"
  std::optional<NamedPlace> place{};
  Table table = Table::holding;  // where there is no place, and
  std::uint16_t address = 0;     // the number in it
  bool is_value = false;         // of a device without registers: looked at past the line
};

/// How a device must answer each request of a step: done, an exception, or nothing.
struct Answer {
  std::optional<int> exception{};
  std::optional<SimTime> silence{};  // for how long nothing may come
  bool is_good() const { return !exception && !silence; }
};

/// On which line a step speaks to its devices, `via: LINE` beside it; none: on the first that each is on.
using Via = std::optional<std::size_t>;

/// write: { feeder.Aaxis_Pulse: 32000, feeder.Aaxis_Move_INC: 1 }, and exception: 3 beside it where the
/// device is to refuse, or reply: nothing where no answer may come. Over the line, in this order; ascending
/// neighbours share a request.
struct WriteStep {
  struct Entry {
    Target target;
    std::string value;  // an expression, evaluated when the step is played
  };
  std::vector<Entry> entries;
  Answer answer{};
  Via via{};
};

/// expect: { feeder.Cord_A: 32000, feeder.STATUS.4: 0 }, read over the line; exception, reply: as for write.
struct ExpectStep {
  struct Entry {
    Target target;
    world::Tolerance value;
  };
  std::vector<Entry> entries;
  Answer answer{};
  Via via{};
};

/// command: { cell: "MOVE X 1000" }: what a model calls a message through its window, in one request each;
/// exception, reply: as for write.
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
  /// The names in `until` are read over the line this often; without it every tick is looked at.
  std::optional<SimTime> poll;
  Via via{};  // where they are read
};

struct AdvanceStep {
  SimTime by{0};
};

/// assert: EXPRESSION, or a list of them: the truth at this moment, without the line.
struct AssertStep {
  std::vector<std::string> expressions;
};

/// always: or never: { what: EXPRESSION, name: NAME }, or the expression alone: holds at every tick from now
/// on, until end: NAME or the end of the scenario.
struct SpanStep {
  std::string expression;
  bool never = false;
  std::string name;  // the expression, if no other was given
};
struct EndSpanStep {
  std::string name;
};

/// input: { feeder.DIN_10: on, feeder.AIN_A: 2.5V }
struct InputStep {
  std::vector<world::InputSetup> inputs;
};

/// turn: { mill.MPG: 400, in: 2s }: hand wheels, and what else is counted
struct TurnStep {
  std::vector<world::Fault> turns;
};

/// inject: { stall: feeder.A, name: NAME }
struct InjectStep {
  world::Fault fault;
  std::string name;  // of this fault, for `clear`; its text, if no other was given
};
/// clear: NAME, or all
struct ClearStep {
  std::string name;  // empty: all
};

/// power: { feeder: off }, on or cycle
struct PowerStep {
  enum class To : std::uint8_t { off, on, cycle };
  std::vector<std::pair<std::size_t, To>> devices;
};

/// send: { line: rs485, bytes: 01 03 00 01 00 01 D5 CA, reply: 01 03 02 C0 01 29 84, within: 100ms }; reply:
/// nothing, where no byte may come in that time; without reply whatever comes is taken.
struct SendStep {
  std::size_t line = 0;
  std::vector<std::uint8_t> bytes;
  std::optional<std::vector<std::uint8_t>> reply;  // empty: nothing may come
  SimTime within = std::chrono::milliseconds(500);
};

/// send: { line: serial, text: "?PE", reply: "100", within: 100ms }: a line of text, without its end; reply:
/// one line, or a list of them, or nothing, where none may come in that time; without reply the device only
/// hears it. hear: { line: serial, text: "DONE", within: 2s }: lines that it sends unasked, since the last
/// `send`.
struct TextStep {
  std::size_t line = 0;
  std::optional<std::string> text;                // none: only heard
  std::optional<std::vector<std::string>> lines;  // empty: nothing may come
  SimTime within = std::chrono::milliseconds(500);
};

/// program: { feeder: indexing.lst }
struct ProgramStep {
  std::size_t device = 0;
  std::string text;
  std::string file;                      // for messages
  std::optional<std::string> refused{};  // it must be; what is said of it has this in it
  bool asks = true;                      // whether it is taken; else either will do
};

/// memory: { feeder: after.json }: the device's non-volatile memory must be what the file says; save: writes
/// the file.
struct MemoryStep {
  enum class What : std::uint8_t { expect, save } what = What::expect;
  std::size_t device = 0;
  std::string file;
};

/// snapshot: NAME and restore: NAME
struct SnapshotStep {
  std::string name;
};
struct RestoreStep {
  std::string name;
};

/// fork: { NAME: [ steps ], NAME: [ steps ] }: each continuation begins from the state at this moment; the
/// steps that follow the fork go on from it as well.
struct ForkStep {
  struct Branch {
    std::string name;
    Steps steps;
  };
  std::vector<Branch> branches;
};

/// reset: peaks: the greatest speeds and accelerations are counted anew
struct ResetPeaksStep {};

/// say: TEXT, for whoever reads along
struct SayStep {
  std::string text;
};

struct Step {
  std::string file;  // where it stands
  int line = 0;
  std::string text;  // what it does, on one line: "write feeder.Aaxis_SVON=1"
  std::variant<WriteStep, CommandStep, ExpectStep, WaitStep, AdvanceStep, AssertStep, SpanStep, EndSpanStep,
               InputStep, TurnStep, InjectStep, ClearStep, PowerStep, SendStep, TextStep, ProgramStep,
               MemoryStep, SnapshotStep, RestoreStep, ForkStep, ResetPeaksStep, SayStep>
      what;
};

/// One case of a scenario file: a file with a table of cases makes one for each row.
struct Scenario {
  std::string name;  // with the case's parameters: "a move takes its time (speed=200)"
  std::string file;
  world::Bench bench;
  SimTime gap{0};  // between two requests of the host, beyond t3.5
  std::uint64_t seed = 0;
  Steps steps;
  std::vector<FileClaim> files{};    // that it is read from, the bench's as well
  std::vector<std::string> saved{};  // paths that its steps write
  Case which{};
};

}  // namespace understudy::emulator::play
