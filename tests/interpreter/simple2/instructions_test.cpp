// The instruction table compared with the manual's list.
#include "interpreter/simple2/instructions.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/interpreter/facts.h"

namespace understudy::interpreter::simple2 {
namespace instructions_test {

std::vector<Fact> facts() { return read_facts(std::string(TEST_FACTS) + "/simple2/instructions.csv"); }

/// The manual's words for an operand, by their beginning.
Operand operand_of(const std::string& wording) {
  const std::vector<std::pair<std::string, Operand>> wordings = {
      {"N/A", Operand::none},
      {"flag", Operand::flag},
      {"param", Operand::parameter},
      {"imm8", Operand::immediate},
      {"DIN number", Operand::input},
      {"DOUT number", Operand::output},
      {"array logic bits", Operand::output_bits},
      {"array change mask", Operand::output_mask},
      {"logic", Operand::logic},
      {"amount_L", Operand::amount_low},
      {"amount_H", Operand::amount_high},
      {"amount (0-100)", Operand::percent},
      {"loop count", Operand::loop_count},
      {"counter", Operand::counter},
      {"timer", Operand::timer},
      {"STATUS bit", Operand::status_bit},
  };
  for (const auto& [beginning, operand] : wordings) {
    if (wording.starts_with(beginning)) return operand;
  }
  ADD_FAILURE() << "no operand has the words '" << wording << "'";
  return Operand::none;
}

TEST(Simple2Instructions, AreThoseOfTheManualInTheOrderOfOpcodes) {
  const auto wanted = facts();
  ASSERT_EQ(wanted.size(), 115u);
  ASSERT_EQ(kInstructions.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Fact& fact = wanted[i];
    const Instruction& instruction = kInstructions[i];
    EXPECT_EQ(instruction.opcode, std::stoi(fact.at("opcode"), nullptr, 16)) << fact.at("mnemonic");
    EXPECT_EQ(instruction.mnemonic, fact.at("mnemonic")) << fact.at("opcode");
    EXPECT_EQ(instruction.data1, operand_of(fact.at("data1"))) << fact.at("mnemonic");
    EXPECT_EQ(instruction.data2, operand_of(fact.at("data2"))) << fact.at("mnemonic");
  }
}

TEST(Simple2Instructions, EveryOpcodeAndMnemonicStandsForOneInstruction) {
  std::set<int> opcodes;
  std::set<std::string_view> mnemonics;
  for (const Instruction& instruction : kInstructions) {
    EXPECT_TRUE(opcodes.insert(instruction.opcode).second) << instruction.mnemonic;
    EXPECT_TRUE(mnemonics.insert(instruction.mnemonic).second) << instruction.mnemonic;
  }
}

TEST(Simple2Instructions, EveryKindOfOperandHasAWordingOfItsOwn) {
  std::set<std::string_view> wordings;
  for (int kind = 0; kind <= static_cast<int>(Operand::status_bit); ++kind) {
    const std::string_view wording = describe(static_cast<Operand>(kind));
    EXPECT_FALSE(wording.empty()) << kind;
    EXPECT_TRUE(wordings.insert(wording).second) << wording;
  }
}

}  // namespace instructions_test
}  // namespace understudy::interpreter::simple2
