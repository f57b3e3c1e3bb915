// Turns a YAML text into its one document, or into one line that says in plain words why it is not one.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace understudy::emulator::world {

/// A piece of YAML. An alias is the very node that it names, so a node may be in several places, and even
/// inside itself.
struct YamlNode {
  enum class Kind : std::uint8_t { nothing, scalar, list, map } kind = Kind::nothing;
  int line = 0;  // from 0 on
  int column = 0;
  std::string scalar{};
  std::vector<const YamlNode*> parts{};  // of a list; of a map: key, value, key, value
};

/// The one document of a text, which may be of any kind. Messages call it `what`. Reads no further than the
/// beginning of a second document, which is refused. Throws FileError. All nodes live as long as any of them
/// is held.
std::shared_ptr<const YamlNode> parse_yaml(const std::string& text, const std::string& file,
                                           const std::string& what);

}  // namespace understudy::emulator::world
