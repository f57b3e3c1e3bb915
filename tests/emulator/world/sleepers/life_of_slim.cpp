#include <cstdint>

#include "tests/emulator/world/sleepers/lives.h"

namespace understudy::emulator::world::sleepers {
namespace sleepers_slim {

/// Commands that are allowed in a program; most of them also typed.
std::string some_line(Draw& draw) {
  const std::string module = draw.one_in(2) ? "" : draw.one_in(2) ? "T1" : "T2";
  const std::string far = std::to_string(draw.of_any_size_and_sign(40'000));
  const std::string near = draw.number(0, 900);
  switch (draw.between(0, 29)) {
    case 0: return module + "JGF";
    case 1: return module + "JGR";
    case 2: return module + "JG0";
    case 3: return module + "H";
    case 4: return "VM=" + near;
    case 5: return "P1SET P" + draw.number(1, 4) + "," + far;
    case 6: return "P2CLR P" + draw.number(1, 4) + "," + far;
    case 7: return "SET P" + draw.number(1, 4);
    case 8: return "CHG P" + draw.number(1, 4);
    case 9: return "PLS P" + draw.number(1, 4) + "," + draw.number(1, 40);
    case 10: return "PWM P" + draw.number(1, 4) + "," + draw.number(1, 500) + "," + draw.number(0, 100);
    case 11: return "2MR " + far + "," + near;
    case 12: return "2MA " + far + "," + near;
    case 13: return draw.one_in(2) ? "AVM" : "HOFF";
    case 14: return draw.one_in(2) ? "PZ" : "REDO";
    case 15: return "CS " + near;
    case 16: return "N" + draw.number(0, 4) + "=" + near;
    case 17: return "AIN=N0";
    case 18: return module + "FT " + draw.number(1, 20000);
    case 19: return "SAVE D";
    case 20: return "TAPZ";
    case 21: return "TAREDO";
    case 22: return "HON";
    case 23:
    case 24: return "DN";
    default: return module + (draw.one_in(3) ? "MA " : "MR ") + far;
  }
}

/// Commands that wait, jump and query.
std::string flow_line(Draw& draw) {
  const std::string input = draw.number(1, 8);
  switch (draw.between(0, 12)) {
    case 0: return "WI " + input;
    case 1: return "WNI " + input;
    case 2:
    case 3: return "WT " + draw.number(1, 900);
    case 4: return "JI " + input + ",$A";
    case 5: return "JNI " + input + ",$B";
    case 6: return "JTI " + input + "," + draw.number(1, 500) + ",$B";
    case 7: return "JNTI " + input + "," + draw.number(1, 500) + ",$A";
    case 8: return "JG " + draw.number(0, 900) + ",N0,$B";
    case 9: return draw.one_in(2) ? "N1=GETI" : "N0=TM";
    case 10: return "SET EV" + draw.number(1, 3) + " I," + input;
    case 11: return "ON EV" + draw.number(1, 3) + ",$E";
    default: return "OUT \"x\"";
  }
}

std::string listing(Draw& draw) {
  std::string text = "$A\n";
  for (auto lines = draw.between(1, 8); lines > 0; --lines)
    text += (draw.one_in(2) ? some_line(draw) : flow_line(draw)) + "\n";
  text += "$B\n";
  for (auto lines = draw.between(0, 5); lines > 0; --lines)
    text += (draw.one_in(2) ? some_line(draw) : flow_line(draw)) + "\n";
  text += draw.one_in(2) ? "JP $A\n" : "RET\n";
  return text + "$E\n" + some_line(draw) + "\nRET\n";
}

class SlimLife final : public Life {
 public:
  std::string model(Draw&) const override { return "slim"; }
  std::string keys(Draw&) const override { return ", modules: 3"; }
  std::string program(Draw& draw) const override { return draw.one_in(3) ? "" : listing(draw); }
  std::vector<Act> first_acts(Draw& draw) const override {
    std::vector<Act> acts{line_act("TX=0\r"), line_act("TY=1\r")};
    if (draw.one_in(2)) acts.push_back(line_act("G\r"));
    return acts;
  }
  Act act(Draw& draw) const override {
    switch (draw.between(0, 20)) {
      case 0:
      case 1: return line_act("G\r");
      case 2: return line_act(draw.one_in(3) ? "TASTOP\r" : "TAUPZ\r");
      case 3: return line_act("?PE\r");
      case 4: return line_act(draw.number(0, 500) + "\r");
      case 5: return line_act("SET EV" + draw.number(1, 3) + " I," + draw.number(1, 8) + "\r");
      case 6: return line_act("ON EV" + draw.number(1, 3) + ",$E\r");
      case 7: return line_act(draw.one_in(3) ? "RESET\r" : "CLR BUF\r");
      case 8: return program_act(listing(draw));
      case 9: return assign_act("N" + draw.number(0, 4), static_cast<double>(draw.between(0, 900)));
      default: return line_act(some_line(draw) + "\r");
    }
  }
};

}  // namespace sleepers_slim

std::unique_ptr<Life> life_of_slim() { return std::make_unique<sleepers_slim::SlimLife>(); }

}  // namespace understudy::emulator::world::sleepers
