// A model made of a description: what the other models have as constants, it owns.
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

/// The rows of a list as a map takes them; they refer to it. `fields` gets the bits with names.
std::vector<RegisterRow> plain_rows(std::span<const ListedRegister> registers,
                                    std::vector<std::vector<BitField>>& fields);

class ImportedModel {
 public:
  /// Of a description in which everything is where it belongs (emulator/model_file/ sees to that).
  explicit ImportedModel(Description description);
  ImportedModel(const ImportedModel&) = delete;  // what it owns is referred to
  ImportedModel& operator=(const ImportedModel&) = delete;

  const Model& model() const { return model_; }
  const Description& description() const { return description_; }
  /// Of each register of the list: where it stands in a device's image (Place::kNoSlot: nowhere), its type,
  /// and what it shows.
  int slot_of(std::size_t number) const { return slots_[number]; }
  Type type_of(std::size_t number) const { return description_.registers[number].type; }
  std::span<const ShownPart> shown(std::size_t number) const { return shown_[number]; }

 private:
  std::vector<RegisterRow> bound_rows();
  Model made_model();

  const Description description_;
  const std::vector<std::vector<ShownPart>> shown_;
  std::vector<std::vector<BitField>> fields_;
  const RegisterMap map_;
  std::vector<int> slots_;
  std::vector<PortRow> ports_;
  std::vector<TerminalRow> terminals_;
  std::vector<AxisRow> axes_;
  std::vector<std::string> state_names_;
  std::vector<std::string_view> state_registers_;
  Model model_;
};

}  // namespace understudy::emulator::models::imported
