// Creates a model from a description. It owns the tables that are constants in the other models.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/models/imported/description.h"
#include "emulator/models/imported/shown.h"

namespace understudy::emulator::models::imported {

/// Creates the rows for a register map from a list, to which they refer. `fields` receives the named bits.
std::vector<RegisterRow> plain_rows(std::span<const ListedRegister> registers, const MapPolicy& policy,
                                    std::vector<std::vector<BitField>>& fields);

class ImportedModel {
 public:
  /// The description must be consistent (emulator/model_file/ checks this).
  explicit ImportedModel(Description description);
  ImportedModel(const ImportedModel&) = delete;  // other objects refer to its tables
  ImportedModel& operator=(const ImportedModel&) = delete;

  const Model& model() const { return model_; }
  const Description& description() const { return description_; }
  /// For a register's number in the list, these return its slot in a device's image (Place::kNoSlot: none),
  /// its type, and the state that it shows.
  int slot_of(std::size_t number) const { return slots_[number]; }
  Type type_of(std::size_t number) const { return description_.registers[number].type; }
  const std::vector<std::size_t>& bcd_registers() const { return bcd_registers_; }
  std::span<const ShownPart> shown(std::size_t number) const { return shown_[number]; }
  /// Returns true if an output may change with each pulse of an axis, because of the state that it shows.
  bool output_moves(std::size_t terminal) const { return moving_outputs_[terminal]; }
  /// Returns true if a number that an axis uses may change with each pulse. It is then read in each tick.
  bool numbers_move() const { return numbers_move_; }

 private:
  std::vector<RegisterRow> bound_rows();
  Model made_model();
  std::optional<std::string> name_of(const Spot& spot) const;
  void find_stops();
  void find_what_moves();

  const Description description_;
  const std::vector<std::vector<ShownPart>> shown_;
  std::vector<std::vector<BitField>> fields_;
  const RegisterMap map_;
  std::vector<int> slots_;
  std::vector<std::size_t> bcd_registers_;
  std::vector<bool> moving_outputs_;  // true for outputs that may change with each pulse, by terminal
  bool numbers_move_ = false;
  std::vector<IdentityObject> identity_;
  std::vector<PortRow> ports_;
  std::vector<TerminalRow> terminals_;
  std::vector<AxisRow> axes_;
  std::vector<std::string> state_names_;
  std::vector<std::string_view> state_registers_;
  std::vector<std::string> stop_names_;
  std::vector<StopStep> stops_;
  Model model_;
};

}  // namespace understudy::emulator::models::imported
