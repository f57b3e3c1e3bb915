// Parses a YAML text that contains a single document. If the text is not YAML, throws an error that consists
// of one plain line.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace understudy::emulator::world {

/// A YAML node. An alias is the same node as its anchor, so a node may be in several places, and even inside
/// itself.
struct YamlNode {
  enum class Kind : std::uint8_t { nothing, scalar, list, map } kind = Kind::nothing;
  int line = 0;  // counted from 0
  int column = 0;
  /// For a block (`|`): its first line, counted from 0, and the number of blanks that precede each of its
  /// lines. 0: the lines of the scalar are not lines of the file.
  int text_line = 0;
  int text_column = 0;
  std::string scalar{};
  std::vector<const YamlNode*> parts{};  // the elements of a list; for a map: key, value, key, value
};

/// Returns the root of the text's single document, which may be of any kind. Messages call the document
/// `what`. A second document is refused at its beginning. Throws FileError. All nodes live as long as one of
/// them is in use.
std::shared_ptr<const YamlNode> parse_yaml(const std::string& text, const std::string& file,
                                           const std::string& what);

}  // namespace understudy::emulator::world
