// Converts the names in expressions to requests to real controllers: registers are read (adjacent registers
// in one request), and values of a text controller are queried. A rig can provide other names.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/play/scenario/scenario.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/probe/probe_names.h"

namespace understudy::emulator::play {

class AskedNames final : public world::NameResolver, public world::ValueSource {
 public:
  struct Place {
    std::optional<Target> reg{};          // a register
    std::optional<std::size_t> device{};  // the device whose value is queried
    std::string query{};                  // the text line that queries the value
    bool is_time = false;
    std::string name{};
  };

  /// The inventory must outlive this object.
  explicit AskedNames(const world::Inventory& inventory) : inventory_(inventory), names_(inventory) {}

  world::NamedNumber resolve(std::string_view name) const override;
  world::Number value(std::int32_t handle) const override { return values_.at(handle); }

  /// Returns how to query a name. If the place contains only a name, it cannot be read over the line.
  Place place_of(std::int32_t handle) const;
  void set(std::int32_t handle, world::Number value) { values_[handle] = value; }
  const std::map<std::int32_t, world::Number>& values() const { return values_; }

 private:
  const world::Inventory& inventory_;
  world::ProbeNames names_;
  std::map<std::int32_t, world::Number> values_;
};

}  // namespace understudy::emulator::play
