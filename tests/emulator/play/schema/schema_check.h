// A small validator of JSON Schema (draft 7) for YAML as an editor reads it; it supports what our schemas
// use.
#pragma once

#include <string>

namespace understudy::emulator::play {

/// Returns why a YAML text does not match the schema; empty if it does. Throws std::logic_error for an
/// unknown keyword, because a schema whose parts are ignored would accept everything.
std::string schema_diagnostic(const std::string& schema, const std::string& yaml);

}  // namespace understudy::emulator::play
