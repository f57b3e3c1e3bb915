// For reading control messages. Only files in this folder include it, because the JSON library is slow to
// compile.
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

/// A message that is refused: one line.
struct MessageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What is longer is read aside (Daemon::do_aside): the devices do not wait for a client's large message.
inline constexpr std::size_t kMostAtOnce = std::size_t{16} << 10;  // bytes
/// So many names can be given values at once, all or none.
inline constexpr std::size_t kMostNamed = 4096;

/// As it came, for messages: 'fast', 3.5, [1,3]; cut if it is long.
std::string shown(const Json& value);
/// "Speed: 'fast' is not a number; expected 0 to 32768"
MessageError is_not(std::string_view name, const Json& value, std::string_view what,
                    std::string_view expected = "one");

/// All of these throw MessageError.
void demand_keys(const Json& message, std::initializer_list<std::string_view> known);
const Json& demand(const Json& message, const char* key);
/// A whole number as an integer, any other as a real number.
Json json_of(double value);
std::string demand_text(const Json& message, const char* key);
/// The object under "values"; `expected`: "names and levels".
const Json& demand_values(const Json& message, std::string_view expected);

/// A whole number from 0 to `most`.
std::uint64_t demand_count(const Json& message, const char* key, std::uint64_t most = UINT64_MAX);
/// By its name; the only one if there is none under "device".
std::size_t demand_device(const Daemon& daemon, const Json& message);
/// Its device has power.
void demand_power(const Device& device);

/// The faults, and what they have done.
Json faults_message_part(const world::World& world);

}  // namespace understudy::emulator::serve
