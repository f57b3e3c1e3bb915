#include "emulator/serve/control/message_fields.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "base/text/one_line.h"

namespace understudy::emulator::serve {

void demand_keys(const Json& message, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : message.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw MessageError(understudy::quoted(key) + " is not a key of this message");
    }
  }
}

const Json& demand(const Json& message, const char* key) {
  if (!message.contains(key)) throw MessageError(understudy::quoted(key) + " is missing");
  return message[key];
}

Json json_of(double value) {
  constexpr double kLargest = 9e15;  // all whole numbers up to there are doubles
  if (std::abs(value) > kLargest || std::floor(value) != value) return value;
  return static_cast<std::int64_t>(value);
}

std::string demand_text(const Json& message, const char* key) {
  const Json& text = demand(message, key);
  if (!text.is_string()) throw MessageError(std::string(key) + ": expected a text");
  return text.get<std::string>();
}

}  // namespace understudy::emulator::serve
