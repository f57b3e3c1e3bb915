// Helpers for reading control messages. Only files in this folder include it, because the JSON library is
// slow to compile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace understudy::emulator {
class Device;
}

namespace understudy::emulator::world {
class World;
}

namespace understudy::emulator::serve {

class Daemon;

using Json = nlohmann::ordered_json;

/// Thrown for a message that is refused. The error text is one line.
struct MessageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Longer messages are parsed in a helper thread (Daemon::do_aside), so that devices do not wait for them.
inline constexpr std::size_t kMaxAtOnce = std::size_t{16} << 10;  // bytes
/// The maximum number of members of an object in a message, and therefore of names that can be set together
/// (all or none).
inline constexpr std::size_t kMaxNamed = 4096;

/// Returns the value as it was received, for messages: 'fast', 3.5, [1,3]. A long value is shortened.
std::string shown(const Json& value);
/// Returns an error such as "Speed: 'fast' is not a number; expected 0 to 32768".
MessageError is_not(std::string_view name, const Json& value, std::string_view what,
                    std::string_view expected = "one");

/// The functions below throw MessageError.
void require_keys(const Json& message, std::initializer_list<std::string_view> known);
const Json& require(const Json& message, const char* key);
/// Returns a whole number as an integer, and any other number as a real.
Json json_of(double value);
std::string require_text(const Json& message, const char* key);
/// Returns the object in "values". `expected` is for messages: "names and levels".
const Json& require_values(const Json& message, std::string_view expected);

/// Returns false if the key is missing.
bool flag_or_false(const Json& message, const char* key);
/// Returns an integer from 0 to `max`.
std::uint64_t require_count(const Json& message, const char* key, std::uint64_t max = UINT64_MAX);
/// Returns the device in "device"; without that key, the only device.
std::size_t require_device(const Daemon& daemon, const Json& message);
/// Throws if the device has no power.
void require_power(const Device& device);

/// Returns the faults and their hits.
Json faults_message_part(const world::World& world);

}  // namespace understudy::emulator::serve
