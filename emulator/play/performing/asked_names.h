// The names of expressions as requests to real controllers: registers are read, neighbours in one request;
// values of a text controller are queried. A rig may know other names.
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
    std::optional<std::size_t> device{};  // of a value that is queried,
    std::string query{};                  // by this line
    bool is_time = false;
    std::string name{};
  };

  /// The inventory must outlive it.
  explicit AskedNames(const world::Inventory& inventory) : inventory_(inventory), names_(inventory) {}

  world::NamedNumber resolve(std::string_view name) const override;
  world::Number value(std::int32_t handle) const override { return values_.at(handle); }

  /// Returns how a name is asked. A place with nothing but a name is not on the line.
  Place place_of(std::int32_t handle) const;
  void set(std::int32_t handle, world::Number value) { values_[handle] = value; }
  const std::map<std::int32_t, world::Number>& values() const { return values_; }

 private:
  const world::Inventory& inventory_;
  world::ProbeNames names_;
  std::map<std::int32_t, world::Number> values_;
};

}  // namespace understudy::emulator::play
