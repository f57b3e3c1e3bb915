// Binds texts in a model file to registers in its list: "STATUS.READY", "COMMAND == 2", "30".
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/register_map/register_map.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

/// All functions throw FileError with the position of the field.
class Binder {
 public:
  /// Both arguments must outlive this object. The map contains the description's registers, without bindings.
  Binder(const models::imported::Description& description, const RegisterMap& map)
      : description_(description), map_(map) {}

  /// Returns a register (or some of its bits) that is read.
  models::imported::Spot spot(const world::YamlFields& field, const std::string& name) const;
  models::imported::Spot spot(const world::YamlFields& field) const { return spot(field, field.text()); }

  /// Returns where a value is shown to hosts. Flags are shown in one bit or in a register, other values in a
  /// whole register. Registers that already show something else are refused, as are registers that hosts
  /// write (unless `may_be_written`). `what` is for messages: "A.busy".
  models::imported::Spot shown(const world::YamlFields& field, const std::string& name, bool is_flag,
                               const std::string& what, bool may_be_written = false);

  /// Reads "CONTROL.0" or "COMMAND == 2".
  models::imported::Condition condition(const world::YamlFields& field) const;
  /// Like condition(), but only for one or 16 bits of registers that hosts write.
  models::imported::Condition level(const world::YamlFields& field) const;
  models::imported::Condition command(const world::YamlFields& field) const;
  /// Reads a register or a number.
  models::imported::Quantity quantity(const world::YamlFields& field, const std::string& text) const;
  models::imported::Quantity quantity(const world::YamlFields& field) const {
    return quantity(field, field.text());
  }
  /// Reads a time in seconds: either a duration, or a register whose unit in the list is a unit of time.
  models::imported::Quantity time(const world::YamlFields& field) const;
  /// Reads "TEMPERATURE > LIMIT", without setting its spot.
  models::imported::Comparison comparison(const world::YamlFields& field) const;

 private:
  const models::imported::ListedRegister& listed(const models::imported::Spot& spot) const {
    return description_.registers[spot.number];
  }

  const models::imported::Description& description_;
  const RegisterMap& map_;
  std::map<std::size_t, std::vector<std::pair<std::uint32_t, std::string>>>
      taken_;  // the bits in use, and what they show
};

}  // namespace understudy::emulator::model_file
