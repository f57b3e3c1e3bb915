#include "emulator/models/super_40nc/rows/terminals.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include "emulator/device/model.h"
#include "emulator/models/super_40nc/rows/contact_rows.h"

namespace understudy::emulator::models::super_40nc {

namespace {

struct MadeTerminals {
  std::vector<std::string> names;
  std::vector<TerminalRow> rows;
};

MadeTerminals make_terminals() {
  using Kind = TerminalRow::Kind;
  MadeTerminals made;
  made.names.reserve(kTerminalCount);  // rows point into this vector
  const auto add = [&](Kind kind, std::string name, std::int32_t highest = 1) {
    made.names.push_back(std::move(name));
    made.rows.push_back({.kind = kind, .name = made.names.back(), .lowest = 0, .highest = highest});
  };
  for (int i = 0; i < kInputCount; ++i) add(Kind::digital_in, "X" + std::to_string(i));
  for (int i = 0; i < kOutputCount; ++i) add(Kind::digital_out, "Y" + std::to_string(i));
  for (const std::string_view axis : kAxisNames) {
    for (const char* pin : {"ALM_", "EZ_", "INP_", "RDY_"}) add(Kind::digital_in, pin + std::string(axis));
  }
  add(Kind::counted_in, "MPG");
  add(Kind::digital_in, "CEMG");
  for (int i = 1; i <= kAnalogInCount; ++i) {
    add(Kind::analog_number, "VR" + std::to_string(i), kMaxAnalogCount);
  }
  for (int i = 1; i <= kAnalogOutCount; ++i) {
    add(Kind::analog_out, "Vout" + std::to_string(i), kMaxMillivolts);
  }
  add(Kind::dip_switch, "PLC_RUN");
  for (const std::string_view axis : kAxisNames) add(Kind::digital_in, "DOG_" + std::string(axis));
  for (int i = 1; i <= kAnalogInCount; ++i) {
    add(Kind::analog_in, "Vin" + std::to_string(i), kMaxMillivoltsIn);
  }
  for (const std::string_view axis : kAxisNames) add(Kind::digital_out, "SVON_" + std::string(axis));
  for (const std::string_view axis : kAxisNames) {
    add(Kind::digital_in, "CLR_" + std::string(axis));
    add(Kind::digital_in, "LTC_" + std::string(axis));
    add(Kind::digital_out, "ERC_" + std::string(axis));
  }
  return made;
}

}  // namespace

std::span<const TerminalRow> terminals() {
  static const MadeTerminals made = make_terminals();
  return made.rows;
}

}  // namespace understudy::emulator::models::super_40nc
