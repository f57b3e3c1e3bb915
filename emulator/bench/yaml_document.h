// A text in YAML into its one document, or into one line that says in plain words why it is not one.
#pragma once

#include <string>

namespace YAML {
class Node;
}

namespace understudy::emulator {

/// The one document of a text, which may be of any kind. Messages call it `what`. Reads no further than the
/// beginning of a second document, which is refused. Throws FileError.
YAML::Node parse_yaml(const std::string& text, const std::string& file, const std::string& what);

}  // namespace understudy::emulator
