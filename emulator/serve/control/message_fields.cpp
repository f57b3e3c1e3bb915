#include "emulator/serve/control/message_fields.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "base/text/one_line.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/names/names.h"
#include "emulator/world/world.h"

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

std::uint64_t demand_count(const Json& message, const char* key, std::uint64_t most) {
  const Json& value = message[key];
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) {
    throw MessageError(std::string(key) + ": expected a whole number" +
                       (most == UINT64_MAX ? "" : " of at most " + std::to_string(most)));
  }
  return value.get<std::uint64_t>();
}

std::size_t demand_device(const Daemon& daemon, const Json& message) {
  return world::find_device(daemon.world().known(),
                            message.contains("device") ? demand_text(message, "device") : std::string());
}

}  // namespace understudy::emulator::serve
