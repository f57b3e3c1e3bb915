// Choices about operands, shown by programs that run in the device. Started at tick 10, a program runs a line
// at 12, 14 and so on.
#include "interpreter/simple2/parameter_names.h"
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_operands_test {

// CMD of the lines used here.
constexpr std::uint16_t kWaitIo = 0x01, kJump = 0x03, kOut = 0x05, kOutAll = 0x06, kOutSelect = 0x09;
constexpr std::uint16_t kLoad = 0x61, kCopy = 0x62, kInc = 0x6B, kDec = 0x6C, kDirect = 0x6F;
constexpr std::uint16_t kInvert = 0x93, kInvertTo = 0x94, kIncTo = 0x95, kDecTo = 0x96;
constexpr std::uint16_t kVar0 = 32, kAnalogA = 156, kEncoderBRpm = 170;

const ProgramLine kTheEnd{0xFF, 0, 0, 0};

bool runs(OneSimple2& feeder) { return feeder.bit("PROG_MAIN_RunTime_Status"); }

TEST(ChoicesProgram, LogicBeyond1IsOnOrAsItsLowestBitSays) {
  struct Expected {
    Value by_2, by_3;  // DOUT_ALL after lines with the logic 2, or 3
  };
  // The first line switches DOUT 6 on or off, the second all, the third 0 and 2.
  const std::pair<const char*, std::vector<ProgramLine>> programs[] = {
      {"Out", {{kOutAll, 0, 0, 0}, {kOut, 6, 0, 0}}},
      {"Out_ALL", {{kOut, 6, 1, 0}, {kOutAll, 0, 0, 0}}},
      {"Out_Array_Select", {{kOutAll, 1, 0, 0}, {kOutSelect, 0x05, 0, 0}}},
  };
  const std::map<std::string, OptionCases<Expected>> expectations{
      {"Out", {{"not_zero_is_on", {0x40, 0x40}}, {"lowest_bit", {0, 0x40}}}},
      {"Out_ALL", {{"not_zero_is_on", {0x7F, 0x7F}}, {"lowest_bit", {0, 0x7F}}}},
      {"Out_Array_Select", {{"not_zero_is_on", {0x7F, 0x7F}}, {"lowest_bit", {0x7A, 0x7F}}}},
  };
  for (const auto& [name, lines] : programs) {
    for (const auto& [option, expected] : each_option<Expected>("logic_operand", expectations.at(name))) {
      for (const std::uint16_t logic : {2, 3}) {
        OneSimple2 feeder(with("logic_operand", option));
        std::vector<ProgramLine> program = lines;
        program[1][program[1][0] == kOutAll ? 1 : 2] = logic;
        program.push_back(kTheEnd);
        start_with_program(feeder, program);
        feeder.run(20);
        EXPECT_EQ(feeder.get("DOUT_ALL"), logic == 2 ? expected.by_2 : expected.by_3)
            << option << ", " << name << ", " << logic;
      }
    }
  }
}

TEST(ChoicesProgram, AWaitForLogicBeyond1IsForOnOrForItsLowestBit) {
  for (const auto& [option, waits_for_on] :
       each_option<bool>("logic_operand", {{"not_zero_is_on", true}, {"lowest_bit", false}})) {
    OneSimple2 feeder(with("logic_operand", option));
    start_with_program(feeder, {{kWaitIo, 4, 2, 0}, kTheEnd});
    feeder.run(20);
    EXPECT_EQ(runs(feeder), waits_for_on) << option << ": DIN 4 is OFF";
    feeder.input(4, true);
    feeder.run(20);
    EXPECT_FALSE(runs(feeder)) << option;
  }
}

TEST(ChoicesProgram, AReadOnlyWriteIsIgnoredOrEndsTheProgram) {
  const ProgramLine writes[] = {
      {kLoad, kAnalogA, 0, 0},    {kInc, kAnalogA, 0, 0},  {kDec, kEncoderBRpm, 0, 0},
      {kDirect, 157, 5, 0},       {kInvert, 169, 0, 0},    {kCopy, kVar0, kAnalogA, 0},
      {kInvertTo, kVar0, 157, 0}, {kIncTo, kVar0, 169, 0}, {kDecTo, kVar0, kEncoderBRpm, 0},
  };
  // Reading them, and writing what lies next to them, is right.
  const ProgramLine others[] = {{kCopy, kAnalogA, kVar0, 0}, {kCopy, kVar0, 158, 0}, {kOut, 5, kAnalogA, 0}};
  for (const auto& [option, ignored] :
       each_option<bool>("read_only_parameter", {{"ignored", true}, {"ends", false}})) {
    const auto goes_on_behind = [&choice = option](const ProgramLine& line) {
      OneSimple2 feeder(with("read_only_parameter", choice));
      feeder.set("PROG_VAR0", 7);
      start_with_program(feeder, {line, {kOut, 6, 1, 0}, {kJump, 1, 0, 1}});
      feeder.run(20);
      EXPECT_EQ(feeder.get("Analog_A"), 0);
      EXPECT_EQ(feeder.bit("DOUT_6"), runs(feeder));
      return runs(feeder);
    };
    for (const ProgramLine& line : writes) EXPECT_EQ(goes_on_behind(line), ignored) << option << line[0];
    for (const ProgramLine& line : others) EXPECT_TRUE(goes_on_behind(line)) << option << line[0];
  }
}

TEST(ChoicesProgram, TheReadOnlyParametersAreThoseOfReadOnlyRegisters) {
  for (const ParameterRow& parameters : model().parameters) {
    for (const RegisterRow& target : model().registers->rows()) {
      if (target.name != parameters.register_name) continue;
      for (int i = 0; i < parameters.count; ++i) {
        const auto number = static_cast<std::uint8_t>(parameters.first + i);
        EXPECT_EQ(interpreter::simple2::is_read_only(number), target.access == Access::read) << +number;
      }
    }
  }
}

}  // namespace choices_operands_test
}  // namespace understudy::emulator::models::simple2_r3
