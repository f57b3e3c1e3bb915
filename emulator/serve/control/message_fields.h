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

/// All of these throw MessageError.
void demand_keys(const Json& message, std::initializer_list<std::string_view> known);
const Json& demand(const Json& message, const char* key);
/// A whole number as an integer, any other as a real number.
Json json_of(double value);
std::string demand_text(const Json& message, const char* key);

/// A whole number from 0 to `most`.
std::uint64_t demand_count(const Json& message, const char* key, std::uint64_t most = UINT64_MAX);
/// By its name; the only one if there is none under "device".
std::size_t demand_device(const Daemon& daemon, const Json& message);

/// The faults, and what they have done.
Json faults_message_part(const world::World& world);

}  // namespace understudy::emulator::serve
