#include "emulator/serve/control/value_text.h"

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/serve/control/message_fields.h"
#include "emulator/world/expression/number.h"

namespace understudy::emulator::serve {

namespace {

std::string text_of(const Json& value, const std::string& unit_word) {
  const world::Unit unit = unit_word == "ns"   ? world::Unit::nanoseconds
                           : unit_word == "mV" ? world::Unit::millivolts
                                               : world::Unit::none;
  if (unit == world::Unit::none) return value.dump();
  return value.is_number_integer() ? world::number_text(value.get<std::int64_t>(), unit)
                                   : world::number_text(value.get<double>(), unit);
}

}  // namespace

std::vector<std::string> value_lines(const std::string& reply) {
  const Json parsed = Json::parse(reply);
  const Json units = parsed.value("units", Json::object());
  std::vector<std::string> lines;
  for (const auto& [name, value] : parsed.at("values").items()) {
    lines.push_back(name + " " + text_of(value, units.value(name, std::string())));
  }
  return lines;
}

std::string value_text(const std::string& reply) {
  const Json parsed = Json::parse(reply);
  return text_of(parsed.at("value"), parsed.value("unit", std::string()));
}

}  // namespace understudy::emulator::serve
