// Reads the keys of a map one by one, so that all errors in them are reported at once.
#pragma once

#include <span>
#include <string>

#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/schema.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

/// An error in one key does not hide errors in other keys.
class Keys {
 public:
  Keys(const YamlFields& fields, std::span<const Key> known, Diagnostics& diagnostics)
      : fields_(fields), diagnostics_(diagnostics) {
    diagnostics_.attempt([&] { fields_.require_keys(known); });
  }
  /// Calls `how` with the field if it exists. Returns true if there is no error.
  template <typename How>
  bool read(const std::string& key, const How& how) const {
    return diagnostics_.attempt([&] {
      if (const auto field = fields_.find(key)) how(*field);
    });
  }
  /// Like read(), but the field must exist.
  template <typename How>
  bool require(const std::string& key, const How& how) const {
    return diagnostics_.attempt([&] { how(fields_.at(key)); });
  }

 private:
  const YamlFields& fields_;
  Diagnostics& diagnostics_;
};

}  // namespace understudy::emulator::world
