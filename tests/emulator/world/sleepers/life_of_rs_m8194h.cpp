#include <algorithm>
#include <cstdint>

#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/text.h"
#include "tests/emulator/world/sleepers/lives.h"

namespace understudy::emulator::world::sleepers {
namespace sleepers_rs_m8194h {

namespace language = interpreter::rs_m8194h;

std::string some_axes(Draw& draw, std::int64_t max) {
  const std::int64_t mask = draw.one_in(2) ? std::int64_t{1} << draw.between(0, 3) : draw.between(1, 15);
  std::string letters;
  for (int axis = 0; axis < 4; ++axis) {
    if (((std::min(mask, max) >> axis) & 1) != 0) letters += "XYZU"[axis];
  }
  return letters.empty() ? "X" : letters;
}

std::string some_value(Draw& draw, const language::Parameter& row) {
  using language::Kind;
  switch (row.kind) {
    case Kind::axes:
    case Kind::setting_axes: return some_axes(draw, row.max);
    case Kind::axis: return std::string(1, "XYZU"[draw.between(0, 3)]);
    case Kind::axis_or_none: return draw.one_in(2) ? "0" : std::string(1, "XYZU"[draw.between(0, 3)]);
    case Kind::speed: return std::to_string(draw.of_any_size(500'000));
    case Kind::variable: return "VAR" + draw.number(0, 4);
    case Kind::byte_variable: return "bVAR" + draw.number(0, 4);
    case Kind::memory: return "MD" + draw.number(0, 4);
    case Kind::operand: return draw.one_in(2) ? "VAR" + draw.number(0, 4) : draw.number(-5, 900);
    case Kind::arithmetic: return std::string(1, "+-*"[draw.between(0, 2)]);
    case Kind::comparison: return draw.one_in(2) ? "<" : ">=";
    case Kind::any_value: return draw.number(0, 90);
    case Kind::isr_if_used: return draw.number(0, 3);
    case Kind::point_if_used: return std::to_string(draw.of_any_size_and_sign(9000));
    case Kind::number: break;
  }
  if (row.only != 0) {
    for (;;) {
      const std::int64_t number = draw.between(0, 31);
      if (row.lists(number)) return std::to_string(number);
    }
  }
  if (row.max - row.min < 300) return draw.number(row.min, row.max);
  const std::int64_t size = row.min < 0 ? draw.of_any_size_and_sign(20'000) : draw.of_any_size(20'000);
  return std::to_string(std::clamp(size, row.min, row.max));
}

std::string some_line(Draw& draw, bool of_macro) {
  for (;;) {
    const language::CommandRow& row = draw.one_of(language::kCommands);
    const std::string_view name = of_macro ? row.macro_name : row.real_time_name;
    if (name.empty() || row.closes() || name.find("CREATE") != std::string_view::npos) continue;
    if (name.find("FACTORY") != std::string_view::npos || name.find("RESET") != std::string_view::npos) {
      if (!draw.one_in(8)) continue;
    }
    std::string text(name);
    for (std::size_t i = 0; i < row.parameter_count(); ++i) text += " " + some_value(draw, row.parameters[i]);
    if (language::parse_command(text).command) return text;
  }
}

/// Commands that start motion, and commands that read it.
std::string lively_line(Draw& draw) {
  const std::string axis(1, "XYZU"[draw.between(0, 3)]);
  const std::string far = std::to_string(draw.of_any_size_and_sign(30'000));
  switch (draw.between(0, 17)) {
    case 0:
    case 1:
    case 2: return "RSM_FIXED_MOVE " + axis + " " + far;
    case 3: return "RSM_CONTINUE_MOVE " + axis + " " + std::to_string(draw.of_any_size_and_sign(20'000));
    case 4: return "RSM_SET_V " + axis + " " + std::to_string(draw.of_any_size(500'000));
    case 5: return (draw.one_in(2) ? "RSM_STOP_SLOWLY " : "RSM_STOP_SUDDENLY ") + axis;
    case 6: return "RSM_LINE_2D " + far + " " + std::to_string(draw.of_any_size_and_sign(9000));
    case 7: return "RSM_ARC_CW " + far + " " + std::to_string(draw.of_any_size_and_sign(3000)) + " 0 0";
    case 8: return "RSM_HOME_START " + axis;
    case 9: return "RSM_SET_COMPARE " + axis + " " + draw.number(0, 1) + " " + draw.number(0, 1) + " " + far;
    case 10: return "RSM_SET_LP " + axis + " " + far;
    case 11: return "RSM_MP_CALL " + draw.number(1, 3);
    case 12: return draw.one_in(2) ? "RSM_ENABLE_INT" : "RSM_INTFACTOR_ENABLE X 4 1";
    case 13:
      return "RSM_SYNC_ACTION " + axis + " " + std::string(1, "XYZU"[draw.between(0, 3)]) + " " +
             std::to_string(1 << draw.between(0, 7)) + " " + draw.number(0, 6) + " " + draw.number(0, 2) +
             " " + draw.number(0, 4) + " " + draw.number(0, 1) + " " + draw.number(0, 1) + " 1 2 3 0";
    case 14:
      return "RSM_SET_OUT " + axis + " " + draw.number(0, 1) + " " + draw.number(0, 1) + " " +
             draw.number(0, 7);
    default: return "RSM_CLEAR_STOP XYZU";
  }
}

class RsM8194hLife final : public Life {
 public:
  std::string model(Draw&) const override { return "rs-m8194h"; }
  std::string keys(Draw& draw) const override { return draw.one_in(2) ? ", set: { FRNET_EVENT: 1 }" : ""; }
  std::string program(Draw& draw) const override {
    std::string text;
    for (const char* name : {"MP 1", "MP 2", "MP 3", "ISR 1", "ISR 2"}) {
      if (!draw.one_in(2)) continue;
      text += std::string(name) + "\n";
      const bool loops = name[0] == 'M' && draw.one_in(2);
      if (loops) text += "RSM_MACRO_FOR 3\n";
      for (auto lines = draw.between(1, 6); lines > 0; --lines) text += plain_macro_line(draw) + "\n";
      if (loops) text += "RSM_MACRO_NEXT\n";
      text += "END\n";
    }
    static const std::string kWhen[] = {"off_to_on", "on_to_off", "on", "off", "change"};
    static const std::string kWhat[] = {"MP1",         "MP2",   "hold X",    "abort_command",
                                        "abort_macro", "pause", "clear_stop"};
    for (int channel = 0; channel < 4; ++channel) {
      if (draw.one_in(3))
        text += "TRIGGER 8." + std::to_string(channel) + " " + draw.one_of(kWhen) + " " + draw.one_of(kWhat) +
                "\n";
    }
    return text;
  }
  std::vector<Act> first_acts(Draw& draw) const override {
    std::vector<Act> acts;
    for (const char* text : {"RSM_SET_MAX_V XYZU 500000", "RSM_SET_SV XYZU 1000", "RSM_SET_V XYZU 20000",
                             "RSM_SET_A XYZU 1000000", "RSM_AXIS_ASSIGN X Y 0"}) {
      if (!draw.one_in(20)) acts.push_back(command_act(text));
    }
    return acts;
  }
  Act act(Draw& draw) const override {
    if (draw.one_in(3)) return command_act(some_line(draw, false));
    return command_act(lively_line(draw));
  }

 private:
  /// No line of a block, which would need its counterpart.
  static std::string plain_macro_line(Draw& draw) {
    for (;;) {
      std::string line = some_line(draw, true);
      bool is_plain = true;
      for (const char* word : {"_IF", "_ELSE", "_END", "_FOR", "_NEXT", "_GOTO", "_LABEL", "_CALL", "_EXIT"})
        is_plain = is_plain && line.find(word) == std::string::npos;
      if (is_plain) return line;
    }
  }
};

}  // namespace sleepers_rs_m8194h

std::unique_ptr<Life> life_of_rs_m8194h() { return std::make_unique<sleepers_rs_m8194h::RsM8194hLife>(); }

}  // namespace understudy::emulator::world::sleepers
