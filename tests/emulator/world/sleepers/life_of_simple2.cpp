#include <cstdint>
#include <iterator>

#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "interpreter/simple2/instructions.h"
#include "tests/emulator/world/sleepers/lives.h"

namespace understudy::emulator::world::sleepers {
namespace sleepers_simple2 {

namespace language = interpreter::simple2;

std::uint16_t operand(Draw& draw, language::Operand kind) {
  using language::Operand;
  switch (kind) {
    case Operand::none: return 0;
    case Operand::flag: return static_cast<std::uint16_t>(draw.between(1, 20));
    case Operand::parameter: return static_cast<std::uint16_t>(draw.between(0, 182));
    case Operand::amount_high: return 0;
    default: return static_cast<std::uint16_t>(draw.between(0, draw.one_in(4) ? 200 : 6));
  }
}

/// Lines of any commands, of which the last jumps back to the first. Lines that wait are frequent.
std::vector<std::uint16_t> some_words(Draw& draw) {
  std::vector<std::uint16_t> words;
  const auto lines = static_cast<int>(draw.between(3, 20));
  for (int line = 0; line < lines; ++line) {
    const language::Instruction* instruction = &draw.one_of(language::kInstructions);
    if (draw.one_in(3)) {
      static constexpr std::uint8_t kWaits[] = {0x01, 0x02, 0x24, 0x25, 0x28, 0x34};
      const std::uint8_t opcode = draw.one_of(kWaits);
      for (const auto& each : language::kInstructions) {
        if (each.opcode == opcode) instruction = &each;
      }
    }
    words.push_back(instruction->opcode);
    words.push_back(operand(draw, instruction->data1));
    words.push_back(operand(draw, instruction->data2));
    words.push_back(static_cast<std::uint16_t>(line + 1));
  }
  for (const int word : {0x03, 1, 0, 0}) words.push_back(static_cast<std::uint16_t>(word));
  return words;
}

Act some_program(Draw& draw) {
  return {.words = "a program", .carry_out = [words = some_words(draw)](World& world) {
            if (!world.device(0).powered()) return;
            write_words(*world.device(0).register_bank(), Table::holding, 0x4000, words);
          }};
}

class Simple2Life final : public Life {
 public:
  std::string model(Draw&) const override { return "simple2-r3"; }
  std::string keys(Draw& draw) const override {
    std::string set;
    for (const char* pin :
         {"DIN0_Aaxis_Alarm", "DIN1_Aaxis_Ready", "DIN2_Aaxis_UP_Limit", "DIN3_Aaxis_DN_Limit",
          "DIN4_Aaxis_Home", "DOUT0_Aaxis_SVON", "DOUT1_Aaxis_ACLR", "AutoStart_MainProg",
          "Aaxis_DIR_Polarity", "Baxis_DIR_Polarity", "Baxis_ENC_Polarity"}) {
      if (draw.one_in(3)) set += (set.empty() ? "" : ", ") + std::string(pin) + ": 1";
    }
    return ", set: { " + set + " }" + (draw.one_in(4) ? ", firmware: \"1.40\"" : "");
  }
  std::vector<Act> first_acts(Draw& draw) const override {
    std::vector<Act> acts{write_act("ALL_SVON", 1), some_program(draw)};
    if (draw.one_in(2)) acts.push_back(write_act("PROG_MAIN_RunTime_START", 0));
    return acts;
  }
  Act act(Draw& draw) const override {
    const std::string axis = draw.one_in(2) ? "Aaxis_" : "Baxis_";
    switch (draw.between(0, 15)) {
      case 0: return write_act(axis + "GoHome", 1);
      case 1:
      case 2: return write_act(axis + "DirectmRPM", draw.between(-1, 1) * draw.of_any_size(2'000'000));
      case 3: return write_act(axis + "STOP", 1);
      case 4: return write_act(axis + (draw.one_in(3) ? "SyncMode" : "ACLR"), 1);
      case 5: return write_act(axis + "SVON", draw.one_in(4) ? 0 : 1);
      case 6: return write_act(axis + "DirectPWM", draw.between(0, 100));
      case 7: return some_program(draw);
      case 8:
      case 9: return write_act("PROG_MAIN_RunTime_START", draw.between(0, 6));
      case 10: return write_act("PROG_MEM" + draw.number(0, 31), draw.between(-1000, 1000));
      case 11: return write_act("AutoStart_MainProg", 1);
      case 12: return write_act(axis + "Pulse", draw.of_any_size_and_sign(400'000));
      case 13: return write_act(axis + "Speed", draw.one_in(8) ? 0 : draw.of_any_size(2'000));
      default: return write_act(axis + (draw.one_in(3) ? "Move_ABS" : "Move_INC"), 1);
    }
  }
};

}  // namespace sleepers_simple2

std::unique_ptr<Life> life_of_simple2() { return std::make_unique<sleepers_simple2::Simple2Life>(); }

}  // namespace understudy::emulator::world::sleepers
