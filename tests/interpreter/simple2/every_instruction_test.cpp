// Every instruction of the manual's list, one line at a time.
#include <iomanip>
#include <set>
#include <sstream>

#include "tests/interpreter/facts.h"
#include "tests/interpreter/simple2/instruction_cases.h"

namespace understudy::interpreter::simple2 {
namespace every_instruction_test {

std::vector<InstructionCase> all_cases() {
  std::vector<InstructionCase> all;
  for (const auto& group : {flow_cases(), output_cases(), number_cases(), motion_cases()}) {
    all.insert(all.end(), group.begin(), group.end());
  }
  return all;
}

std::string name_of(const InstructionCase& wanted) {
  std::ostringstream text;
  text << std::hex << std::setfill('0') << "0x" << std::setw(2) << int{wanted.opcode} << std::dec << ' '
       << int{wanted.data1} << ' ' << int{wanted.data2} << " -> '" << wanted.calls << "' and line "
       << wanted.line_after;
  return text.str();
}

TEST(Simple2Instruction, DoesWhatTheManualSays) {
  for (const InstructionCase& wanted : all_cases()) {
    SCOPED_TRACE(name_of(wanted));
    Lines lines{};
    lines[kHere] = {wanted.opcode, wanted.data1, wanted.data2, 0};
    lines[kFlag7].flag = 7;
    ProgramRun run(Program(lines), kHere);
    wanted.before(run.machine);

    run.slot();
    EXPECT_EQ(run.machine.take_calls(), wanted.calls);
    run.slot();
    EXPECT_EQ(run.execution.running ? run.execution.now_line : kEnd, wanted.line_after);
  }
}

TEST(Simple2Instruction, IsNeverLeftOutOfTheCases) {
  std::set<int> opcodes;
  for (const InstructionCase& wanted : all_cases()) opcodes.insert(wanted.opcode);
  for (const Fact& fact : read_facts(std::string(TEST_FACTS) + "/simple2/instructions.csv")) {
    EXPECT_TRUE(opcodes.contains(std::stoi(fact.at("opcode"), nullptr, 16))) << fact.at("mnemonic");
  }
}

TEST(Simple2Instruction, ThatTheManualDoesNotListDoesNothing) {
  std::set<int> listed;
  for (const Fact& fact : read_facts(std::string(TEST_FACTS) + "/simple2/instructions.csv")) {
    listed.insert(std::stoi(fact.at("opcode"), nullptr, 16));
  }
  for (int opcode = 0; opcode < 256; ++opcode) {
    if (listed.contains(opcode)) continue;
    ProgramRun run(program_of({{static_cast<std::uint8_t>(opcode), 1, 1, 0}}));
    run.slot();
    run.slot();
    EXPECT_EQ(run.execution.now_line, 1) << opcode;
    EXPECT_TRUE(run.machine.calls.empty()) << opcode;

    ProgramRun strict(program_of({{static_cast<std::uint8_t>(opcode), 1, 1, 0}}));
    strict.dialect.unknown_command = Dialect::UnknownCommand::ends;
    strict.slot();
    EXPECT_FALSE(strict.execution.running) << opcode;
    EXPECT_EQ(strict.execution.ending, Ending::unknown_command) << opcode;
  }
}

}  // namespace every_instruction_test
}  // namespace understudy::interpreter::simple2
