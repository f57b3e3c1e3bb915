// Binds words of a model file to registers of its list: "STATUS.READY", "COMMAND == 2", "30".
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

/// All functions throw FileError at the field.
class Binder {
 public:
  /// Both must outlive it. The map has the description's registers, without bindings.
  Binder(const models::imported::Description& description, const RegisterMap& map)
      : description_(description), map_(map) {}

  /// Returns a register that is read, or bits of it.
  models::imported::Spot spot(const world::YamlFields& field, const std::string& name) const;
  models::imported::Spot spot(const world::YamlFields& field) const { return spot(field, field.text()); }

  /// Returns where a value is shown to hosts: a flag in one bit or a register, another value in a whole
  /// register. Registers that show something else already, and registers that hosts write (unless
  /// `may_be_written`), are refused. `what` is for messages: "A.busy".
  models::imported::Spot shown(const world::YamlFields& field, const std::string& name, bool is_flag,
                               const std::string& what, bool may_be_written = false);

  /// Reads "CONTROL.0" or "COMMAND == 2".
  models::imported::Condition condition(const world::YamlFields& field) const;
  /// Like condition(), for one or 16 bits, and for registers that hosts write.
  models::imported::Condition level(const world::YamlFields& field) const;
  models::imported::Condition command(const world::YamlFields& field) const;
  /// Reads a register or a number.
  models::imported::Quantity quantity(const world::YamlFields& field, const std::string& text) const;
  models::imported::Quantity quantity(const world::YamlFields& field) const {
    return quantity(field, field.text());
  }
  /// Reads seconds: a register whose unit in the list is a unit of time, or a duration.
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
