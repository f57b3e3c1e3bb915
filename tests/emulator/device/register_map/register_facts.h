// The Simple2-R3's registers from its manual (simple2_r3_registers.csv), typed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/device/register_map/row.h"
#include "tests/interpreter/facts.h"

namespace understudy::emulator {

/// One 16-bit address.
struct RegisterFact {
  std::uint16_t address = 0;
  std::string name;        // as the register table prints it
  std::string other_name;  // a second spelling; empty if there is none
  bool readable = false;
  bool writable = false;
  bool is_32_bit = false;
  bool is_signed = false;
  std::optional<Value> min, max;
  std::string unit;
  bool persistent = false;
  std::uint16_t factory_word = 0;
  char half = ' ';  // 'L', 'H'
  int since = 0;

  Access access() const { return !writable ? Access::read : readable ? Access::read_write : Access::write; }
  /// Returns the limits of the values that the register's words can hold.
  Value lowest() const { return !is_signed ? 0 : is_32_bit ? INT32_MIN : INT16_MIN; }
  Value highest() const {
    if (is_32_bit) return is_signed ? Value{INT32_MAX} : Value{UINT32_MAX};
    return is_signed ? INT16_MAX : UINT16_MAX;
  }
};

inline std::vector<RegisterFact> simple2_r3_registers() {
  std::vector<RegisterFact> registers;
  const auto number = [](const std::string& text) -> std::optional<Value> {
    if (text.empty()) return std::nullopt;
    return std::stoll(text);
  };
  for (const Fact& fact : read_facts(TEST_FACTS "/models/simple2_r3/simple2_r3_registers.csv")) {
    RegisterFact r;
    r.address = static_cast<std::uint16_t>(std::stoul(fact.at("address"), nullptr, 16));
    r.name = fact.at("name");
    r.other_name = fact.at("other_name");
    r.readable = fact.at("access").starts_with('R');
    r.writable = fact.at("access").ends_with('W');
    r.is_32_bit = fact.at("width") == "32";
    r.is_signed = fact.at("signed") == "1";
    r.min = number(fact.at("min"));
    r.max = number(fact.at("max"));
    r.unit = fact.at("unit");
    r.persistent = fact.at("persistent") == "1";
    r.factory_word = static_cast<std::uint16_t>(std::stoul(fact.at("default")));
    if (!fact.at("half").empty()) r.half = fact.at("half")[0];
    r.since = fact.at("since").empty() ? 0 : std::stoi(fact.at("since"));
    registers.push_back(r);
  }
  return registers;
}

/// Returns a name such as "Aaxis_Pulse_L" or "PROG_MEM3_RegL" without the suffix of a half.
inline std::string without_half(const std::string& name) {
  for (const std::string tail : {"_RegL", "_RegH", "_L", "_H"}) {
    if (name.ends_with(tail)) return name.substr(0, name.size() - tail.size());
  }
  return name;
}

}  // namespace understudy::emulator
