#include <cstdint>

#include "tests/emulator/world/sleepers/lives.h"

namespace understudy::emulator::world::sleepers {
namespace sleepers_super_40nc {

/// Operands of a PLC and of step programs: everything that shows something, and some that only store.
std::string contact(Draw& draw) {
  switch (draw.between(0, 11)) {
    case 0:
    case 1: return "X" + draw.number(0, 12);
    case 2: return "X" + draw.number(20, 24);
    case 3: return "Y" + draw.number(0, 9);
    // Rarely contacts that the ladder itself switches, because then it may never settle.
    case 4: return "M" + (draw.one_in(8) ? draw.number(0, 6) : draw.number(20, 32));
    case 5: return "T" + draw.number(0, 5);
    case 6: return "M" + draw.number(8000, 8023);
    case 7: return draw.one_in(2) ? "M8502" : "M" + draw.number(8500, 8600);
    default: return "M" + std::to_string(8000 + 100 * draw.between(1, 4) + draw.between(20, 99));
  }
}

std::string value(Draw& draw) {
  const std::int64_t axis = 8000 + 100 * draw.between(1, 4);
  switch (draw.between(0, 11)) {
    case 0: return "D" + draw.number(0, 9);
    case 1: return "T" + draw.number(0, 5);
    case 2: return "C" + draw.number(0, 5);
    case 3: return "D" + draw.number(8091, 8098);
    case 4: return draw.one_in(3) ? "D8019" : "D" + draw.number(8000, 8007);
    case 5: return "D" + std::to_string(axis);
    case 6: return "D" + std::to_string(axis + 17);
    case 7: return "D" + std::to_string(axis + draw.between(40, 48));
    case 8: return "D" + std::to_string(axis + draw.between(64, 73));
    case 9: return "K" + draw.number(-5, 5000);
    default: return "K" + draw.number(0, 3);
  }
}

std::string comparison(Draw& draw, const std::string& kind) {
  static const std::string kRelations[] = {"=", ">", "<", "<>", "<=", ">="};
  return kind + draw.one_of(kRelations) + " " + value(draw) + " " + value(draw) + "\n";
}

std::string condition(Draw& draw) {
  static const std::string kLoads[] = {"LD", "LDI", "LDP", "LDF"};
  static const std::string kJoins[] = {"AND", "ANI", "OR", "ORI", "ANP", "ORF"};
  std::string text =
      draw.one_in(3) ? comparison(draw, "LD") : draw.one_of(kLoads) + " " + contact(draw) + "\n";
  while (draw.one_in(3)) {
    text += draw.one_in(3) ? comparison(draw, draw.one_in(2) ? "AD" : "OR")
                           : draw.one_of(kJoins) + " " + contact(draw) + "\n";
  }
  return text;
}

std::string network(Draw& draw, int number) {
  const std::string n = std::to_string(number);
  switch (draw.between(0, 15)) {
    case 0: return condition(draw) + "OUT T" + n + " K" + draw.number(1, 3000) + "\n";
    case 1: return condition(draw) + "OUT C" + n + " K" + draw.number(1, 5) + "\n";
    case 2:
      return condition(draw) + "SET Y" + std::to_string(10 + number) + "\n" + condition(draw) + "RST Y" +
             std::to_string(10 + number) + "\n";
    case 3: return condition(draw) + "MOV " + value(draw) + " D" + n + "\n";
    case 4: return "LDP " + contact(draw) + "\nINC D" + n + "\n";
    case 5: return condition(draw) + "PLS M" + n + "\n";
    case 6: return condition(draw) + "ALT M" + n + "\n";
    case 7: {
      static const std::string kActs[] = {"STR * K1",      "STP K1",       "PJG * K1",  "MJG * * K1",
                                          "DRV * * K3000", "SET M8100",    "RST M8100", "SET M8002",
                                          "RST M8002",     "MOV D0 D8117", "SET M8303", "RST M8303"};
      return condition(draw) + draw.one_of(kActs) + "\n";
    }
    case 8:
      return condition(draw) + "OUT Y" + (draw.one_in(4) ? draw.number(0, 9) : draw.number(10, 20)) + "\n";
    default:
      return condition(draw) + "OUT " + (draw.one_in(3) ? "M" + n : "Y" + std::to_string(10 + number)) + "\n";
  }
}

std::string step(Draw& draw, bool is_c) {
  switch (draw.between(0, 13)) {
    case 0: return "TMR K" + draw.number(1, 900) + "\n";
    case 1: return (draw.one_in(2) ? "WAT " : "WTN ") + contact(draw) + "\n";
    case 2: return "MOV " + value(draw) + " D" + draw.number(0, 9) + "\n";
    case 3: return (draw.one_in(2) ? "SET M" : "RST M") + draw.number(20, 32) + "\n";
    case 4: return (draw.one_in(2) ? "SET Y" : "RST Y") + draw.number(10, 20) + "\n";
    case 5: return "INC D" + draw.number(0, 9) + "\n";
    case 6: return draw.one_in(2) ? "ABSC\n" : "INCC\n";
    case 7: return is_c ? "F K" + draw.number(500, 90000) + "\n" : "RPM K" + draw.number(1, 900) + "\n";
    case 8:
      return is_c ? "CCW K" + draw.number(-4000, 4000) + " K1000 K1000\n"
                  : "VDRV K" + draw.number(-300, 300) + "\n";
    case 9:
      return is_c ? "DRV K" + draw.number(-900, 900) + "\n" : draw.one_in(2) ? "HOM K1\n" : "MRK K900\n";
    default:
      return is_c ? "LIN K" + draw.number(-5000, 5000) + " K" + draw.number(-5000, 5000) + "\n"
                  : "DRV K" + draw.number(-9000, 9000) + "\n";
  }
}

std::string listing(Draw& draw) {
  std::string text;
  if (!draw.one_in(6)) {
    text += "AREA PLC\n";
    const auto networks = static_cast<int>(draw.between(1, 7));
    for (int i = 0; i < networks; ++i) text += network(draw, i);
    text += "END\n";
  }
  const bool has_steps = draw.one_in(2);
  for (const char* area : {"C", "X", "Y", "Z", "U"}) {
    if (!has_steps || !draw.one_in(3)) continue;
    text += std::string("AREA ") + area + "\n";
    const bool loops = draw.one_in(2);
    if (loops) text += "LAB K1\n";
    for (auto lines = draw.between(1, 7); lines > 0; --lines) text += step(draw, area[0] == 'C');
    text += std::string(loops ? "TMR K40\nJMP K1\n" : "") + "END\n";
  }
  return text;
}

class Super40ncLife final : public Life {
 public:
  std::string model(Draw&) const override { return "super-40nc"; }
  std::string keys(Draw& draw) const override {
    std::string set = "D9003: " + draw.number(0, 3);
    for (const char* time : {"D9390", "D9391", "D9190", "D9191", "D9028", "D9029"}) {
      if (draw.one_in(2)) set += ", " + std::string(time) + ": " + draw.number(0, 400);
    }
    for (int axis = 1; axis <= 4; ++axis) {
      const std::string d = "D9" + std::to_string(axis);
      if (draw.one_in(3)) set += ", " + d + "23: " + draw.number(0, 3);
      if (draw.one_in(3)) set += ", " + d + "24: " + draw.number(0, 3);
      if (draw.one_in(3)) set += ", " + d + "25: " + draw.number(0, 3);
      if (draw.one_in(4)) set += ", " + d + "50: " + draw.number(0, 3);
      for (int n = 33; n <= 49; ++n) {
        if (draw.one_in(9)) set += ", " + d + std::to_string(n) + ": " + draw.number(0, 6);
      }
    }
    return ", set: { " + set + " }";
  }
  std::string program(Draw& draw) const override { return listing(draw); }
  Act act(Draw& draw) const override {
    const std::string axis = "8" + draw.number(1, 4);
    switch (draw.between(0, 20)) {
      case 0:
      case 1: return write_act("M" + axis + "0" + draw.number(3, 4), draw.between(0, 1));
      case 2: return write_act("M" + axis + "06", draw.between(0, 1));
      case 3: return write_act("D" + axis + "17", draw.between(-10000, 10000));
      case 4: return write_act("M" + draw.number(20, 32), draw.between(0, 1));
      case 5: return write_act("D8022", draw.between(0, 2));
      case 6: return write_act("M" + axis + "02", draw.between(0, 1));
      case 7: return write_act("M" + axis + "05", draw.between(0, 1));
      case 8:
      case 9:
      case 10:
      case 11: return write_act("M8" + draw.number(0, 4) + "00", draw.one_in(3) ? 1 : 0);
      case 12: return write_act("M8006", draw.between(0, 1));
      case 13: return write_act("M85" + draw.number(60, 97), draw.between(0, 1));
      case 14: return write_act(draw.one_in(2) ? "M8001" : "M8004", draw.one_in(4) ? 1 : 0);
      case 15: return write_act("M8002", draw.one_in(3) ? 1 : 0);
      case 16: return write_act(draw.one_in(2) ? "D9001" : "D9002", draw.between(0, 4));
      case 17: return write_act("D8005", draw.between(0, 200));
      case 18: return program_act(listing(draw));
      case 19: return write_act("M" + axis + "0" + draw.number(8, 9), draw.between(0, 1));
      default: return write_act("D" + axis + "4" + draw.number(0, 8), draw.between(-5000, 5000));
    }
  }
};

}  // namespace sleepers_super_40nc

std::unique_ptr<Life> life_of_super_40nc() { return std::make_unique<sleepers_super_40nc::Super40ncLife>(); }

}  // namespace understudy::emulator::world::sleepers
