#include "emulator/serve/control/message_fields.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "base/text/one_line.h"
#include "emulator/device/device.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/names/names.h"
#include "emulator/world/world.h"

namespace understudy::emulator::serve {

void require_keys(const Json& message, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : message.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw MessageError(understudy::quoted(key) + " is not a key of this message");
    }
  }
}

std::string shown(const Json& value) {
  constexpr std::size_t kLongest = 80;
  if (value.is_string()) return understudy::quoted(value.get_ref<const std::string&>());
  const std::string text = one_line(value.dump(-1, ' ', false, Json::error_handler_t::replace));
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

MessageError is_not(std::string_view name, const Json& value, std::string_view what,
                    std::string_view expected) {
  return MessageError(std::string(name) + ": " + shown(value) + " is not " + std::string(what) +
                      "; expected " + std::string(expected));
}

const Json& require(const Json& message, const char* key) {
  if (!message.contains(key)) throw MessageError(understudy::quoted(key) + " is missing");
  return message[key];
}

Json json_of(double value) {
  constexpr double kLargest = 9e15;  // doubles represent all whole numbers up to this one exactly
  if (std::abs(value) > kLargest || std::floor(value) != value) return value;
  return static_cast<std::int64_t>(value);
}

std::string require_text(const Json& message, const char* key) {
  const Json& text = require(message, key);
  if (!text.is_string()) throw is_not(key, text, "a text");
  return text.get<std::string>();
}

const Json& require_values(const Json& message, std::string_view expected) {
  const Json& values = require(message, "values");
  if (!values.is_object() || values.empty()) {
    throw is_not("values", values, "an object of " + std::string(expected), "an object that is not empty");
  }
  return values;
}

bool flag_or_false(const Json& message, const char* key) {
  if (!message.contains(key)) return false;
  if (!message[key].is_boolean()) throw is_not(key, message[key], "true or false");
  return message[key].get<bool>();
}

std::uint64_t require_count(const Json& message, const char* key, std::uint64_t max) {
  const Json& value = message[key];
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > max) {
    throw is_not(key, value, "a whole number",
                 "one of " + (max == UINT64_MAX ? "0 or more" : "0 to " + std::to_string(max)));
  }
  return value.get<std::uint64_t>();
}

void require_power(const Device& device) {
  if (!device.powered()) throw MessageError(device.name() + " has no power; expected it to be on");
}

std::size_t require_device(const Daemon& daemon, const Json& message) {
  return world::find_device(daemon.world().known(),
                            message.contains("device") ? require_text(message, "device") : std::string());
}

}  // namespace understudy::emulator::serve
