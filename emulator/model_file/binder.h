// Words of a model file into registers of its list: "STATUS.READY", "COMMAND == 2", "30".
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

/// All that fails throws FileError, at the field.
class Binder {
 public:
  /// Both must outlive it. The map is one of the description's registers, bound to nothing.
  Binder(const models::imported::Description& description, const RegisterMap& map)
      : description_(description), map_(map) {}

  /// A register that is read, or bits of it.
  models::imported::Spot spot(const world::YamlFields& field, const std::string& name) const;
  models::imported::Spot spot(const world::YamlFields& field) const { return spot(field, field.text()); }

  /// Where something is shown that hosts read; a flag in one bit or a register, else in a whole register.
  /// What shows something already, and what hosts write (unless `may_be_written`), is refused. `what` is for
  /// messages: "A.busy".
  models::imported::Spot shown(const world::YamlFields& field, const std::string& name, bool is_flag,
                               const std::string& what, bool may_be_written = false);

  /// "CONTROL.0", "COMMAND == 2".
  models::imported::Condition condition(const world::YamlFields& field) const;
  /// Likewise, of 16 bits or one; and of what hosts write.
  models::imported::Condition level(const world::YamlFields& field) const;
  models::imported::Condition command(const world::YamlFields& field) const;
  /// A register, or a number.
  models::imported::Quantity quantity(const world::YamlFields& field, const std::string& text) const;
  models::imported::Quantity quantity(const world::YamlFields& field) const {
    return quantity(field, field.text());
  }
  /// Seconds: a register whose unit in the list is one of time, or a duration.
  models::imported::Quantity time(const world::YamlFields& field) const;
  /// "TEMPERATURE > LIMIT", without its spot.
  models::imported::Comparison comparison(const world::YamlFields& field) const;

 private:
  const models::imported::ListedRegister& listed(const models::imported::Spot& spot) const {
    return description_.registers[spot.number];
  }

  const models::imported::Description& description_;
  const RegisterMap& map_;
  std::map<std::size_t, std::vector<std::pair<std::uint32_t, std::string>>>
      taken_;  // bits, and what they show
};

}  // namespace understudy::emulator::model_file
