#include "emulator/models/rs_m8194h/rows/terminals.h"
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/models/rs_m8194h/rows/registers.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

constexpr std::string_view kPinNames[] = {"LMTP_", "LMTN_", "NHOME_", "HOME_", "INDEX_",
                                          "IN3_",  "EXPP_", "EXPN_",  "INP_",  "ALARM_"};

TerminalTables make_tables() {
  using Kind = TerminalRow::Kind;
  TerminalTables made;
  std::vector<Kind> kinds;
  const auto add = [&](Kind kind, const std::string& name) {
    made.names.push_back(name);
    kinds.push_back(kind);
  };
  for (const std::string_view axis : kAxisNames) {
    for (int pin = 0; pin < kPinsOfAxis; ++pin) {
      const bool is_counted =
          pin == static_cast<int>(Pin::external_plus) || pin == static_cast<int>(Pin::external_minus);
      add(is_counted ? Kind::counted_in : Kind::digital_in, std::string(kPinNames[pin]) + std::string(axis));
    }
  }
  add(Kind::digital_in, "EMG");
  add(Kind::dip_switch, "INIT");
  add(Kind::dip_switch, "NO_I8094H");
  for (const std::string_view axis : kAxisNames) add(Kind::digital_out, "SVON_" + std::string(axis));
  for (int i = 0; i < kOuts; ++i) add(Kind::pulse_out, "OUT_" + std::string(kAxisNames[i]));
  const auto add_group = [&](Kind kind, const std::string& name) {
    made.group_names.push_back(name);
    made.groups.push_back(
        {.name = {}, .first = static_cast<int>(made.names.size()), .count = kFrnetChannels});
    for (int i = 0; i < kFrnetChannels; ++i) add(kind, name + "_" + std::to_string(i));
  };
  for (int i = 0; i < kFrnetGroups; ++i) add_group(Kind::digital_in, "DI_" + std::to_string(8 + i));
  for (int i = 0; i < kFrnetGroups; ++i) add_group(Kind::digital_out, "DO_" + std::to_string(i));

  for (std::size_t i = 0; i < made.names.size(); ++i) {
    made.rows.push_back({.kind = kinds[i], .name = made.names[i]});
  }
  for (std::size_t i = 0; i < made.groups.size(); ++i) made.groups[i].name = made.group_names[i];
  for (std::size_t axis = 0; axis < std::size(kAxisNames); ++axis) {
    made.axes.push_back({.name = kAxisNames[axis],
                         .upper_limit_input = terminal(axis, Pin::limit_plus),
                         .lower_limit_input = terminal(axis, Pin::limit_minus),
                         .home_input = terminal(axis, Pin::home),
                         .alarm_input = terminal(axis, Pin::alarm),
                         .servo_output = kFirstServo + static_cast<int>(axis),
                         .near_home_input = terminal(axis, Pin::near_home),
                         .mark_input = terminal(axis, Pin::in3),
                         .index_input = terminal(axis, Pin::index)});
  }
  return made;
}

}  // namespace

const TerminalTables& terminal_tables() {
  static const TerminalTables made = make_tables();
  return made;
}

}  // namespace understudy::emulator::models::rs_m8194h
