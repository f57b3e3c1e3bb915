// SLIM's state as bytes, and back.
#include <cmath>
#include <memory>

#include "emulator/models/slim/chain_fields.h"
#include "emulator/models/slim/device.h"

namespace understudy::emulator::models::slim {

namespace {

/// Holds whatever any device may hold; what its own options make of it comes when all is read.
constexpr lang::ProgramOptions kAnyProgram{
    .dialect = lang::kWidestDialect, .capacity = 4000, .check = lang::ProgramOptions::Check::as_run};

struct Fields {
  // clang-format off
  static void of(Like<lang::Operand> auto& v, auto visit) {
    auto& [a, b, c, d, e] = v; visit(a, b, c, d, e);
  }
  static void of(Like<lang::Frame> auto& v, auto visit) { auto& [a, b, c, d] = v; visit(a, b, c, d); }
  static void of(Like<lang::Event> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g] = v; visit(a, b, c, d, e, f, g);
  }
  static void of(Like<lang::Execution> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j] = v; visit(a, b, c, d, e, f, g, h, i, j);
  }
  static void of(Like<lang::Editor> auto& v, auto visit) { auto& [a, b] = v; visit(a, b); }
  static void of(Like<Errors> auto& v, auto visit) { auto& [a, b] = v; visit(a, b); }
  static void of(Like<Memory> auto& v, auto visit) { auto& [a, b, c, d, e] = v; visit(a, b, c, d, e); }
  static void of(Like<State> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = v; visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  }
  // clang-format on

  static constexpr lang::Operand::Kind last(lang::Operand::Kind) { return lang::Operand::Kind::quantity; }
  static constexpr lang::Hold last(lang::Hold) { return lang::Hold::number; }
  static constexpr lang::Ending last(lang::Ending) { return lang::Ending::failed; }
  static constexpr lang::Error last(lang::Error) { return lang::Error::address; }
  static constexpr lang::Condition last(lang::Condition) { return lang::Condition::not_greater; }
  static constexpr lang::Editor::Mode last(lang::Editor::Mode) { return lang::Editor::Mode::download; }

  // Of other rooms.
  static void write(const Chain& chain, StateWriter& writer) { writer.write<ChainFields>(chain); }
  static void read(Chain& chain, StateReader& reader) { reader.read<ChainFields>(chain); }
  static void write(const lang::Program& program, StateWriter& writer) {
    writer.write<Fields>(program.texts());
  }
  static void read(lang::Program& program, StateReader& reader) {
    std::vector<std::string> texts;
    reader.read<Fields>(texts);
    demand_state(program.set_texts(texts, kAnyProgram), "a line is not a line of a program");
  }

  static void check(const lang::Operand& operand) {
    using Kind = lang::Operand::Kind;
    demand_state(std::isfinite(operand.number), "a number is not finite");
    const bool of_array = is_array(operand.kind) && !operand.index_is_variable;
    const bool of_variables = is_variable(operand.kind) && !of_array;
    const int most = of_array                          ? lang::kArrayCount - 1
                     : of_variables                    ? lang::kVariableCount - 1
                     : operand.kind == Kind::condition ? static_cast<int>(lang::Condition::not_greater)
                                                       : 8;
    demand_within(operand.index, 0, most);
  }
  static void check(const lang::Frame& frame) { demand_reach(frame.until_ms); }
  static void check(const lang::Event& event) {
    // As many operands as its condition looks at.
    const bool compares = event.condition >= lang::Condition::equal;
    demand_state(!event.has_condition || event.operands.size() == (compares ? 2U : 1U),
                 "an event looks at something else");
  }
  static void check(const lang::Execution& execution) {
    demand_reach(execution.until_ms);
    demand_state(execution.stack.size() <= 1000, "a program is nested too deep");
    demand_state(std::isfinite(execution.number), "a number is not finite");
  }
  static void check(const Memory& memory) {
    for (const Parameters& all : memory.parameters) {
      for (std::size_t i = 0; i < kParameterCount; ++i) {
        demand_state(fitted(kParameters[i], all[i]) == all[i], "a parameter is out of range");
      }
    }
    for (const float real : memory.reals) demand_state(std::isfinite(real), "a variable is not finite");
    for (const float real : memory.real_array) demand_state(std::isfinite(real), "a variable is not finite");
  }
  static void check(const State& state) {
    demand_reach(state.powered_at);
    demand_reach(state.clock_zero);
  }
  static void check(const auto&) {}
};

/// What is sound depends on what was chosen; programs become what their lines say here.
void settle_programs(State& state, const lang::FlowOptions& options) {
  const std::vector<std::string> texts = state.program.texts();
  demand_state(state.program.set_texts(texts, options.program), "a line is not a command of a program");
  lang::Program kept;
  demand_state(kept.set_texts(state.kept_program, options.program),
               "a kept line is not a command of a program");
  demand_within(state.editor.line, 0, options.program.capacity);
  demand_within(state.execution.line, 0, options.program.capacity);
  demand_state(is_sound(state.execution, state.program, options), "the program does what no program can");
}

}  // namespace

void Slim::write_own_state(StateWriter& writer) const { writer.write<Fields>(settled()); }

std::function<void()> Slim::read_own_state(StateReader& reader) {
  const auto restored = std::make_shared<State>();
  reader.read<Fields>(*restored);
  settle_programs(*restored, flow_options_);
  // What else only this bench's choices tell.
  for (const Errors& errors : restored->errors) {
    demand_state(errors.history.size() <= history_length(), "too many errors are remembered");
  }
  const auto check_integers = [&](const auto& integers) {
    const int least = of_programs().dialect.integer_least;
    for (const std::int16_t value : integers) demand_within(value, least, lang::kIntegerMost);
  };
  for (const Memory* const memory : {&restored->ram, &restored->kept}) {
    check_integers(memory->integers);
    check_integers(memory->integer_array);
  }
  return [this, restored] { state_ = *restored; };
}

}  // namespace understudy::emulator::models::slim
