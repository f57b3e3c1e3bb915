// A small judge of JSON Schema (draft 7), for YAML as an editor reads it: as much of it as our schemas use.
#pragma once

#include <string>

namespace understudy::emulator::play {

/// Why a YAML text does not suit the schema; empty if it does. Throws std::logic_error for a keyword it does
/// not know, since a schema whose parts are passed over would be judged to suit everything.
std::string schema_diagnostic(const std::string& schema, const std::string& yaml);

}  // namespace understudy::emulator::play
