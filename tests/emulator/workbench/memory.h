// The persistent memory of the tests' controller: registers in an EEPROM and also in battery RAM, files and
// recipes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/state/fields.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/eeprom_fields.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator::workbench {

inline constexpr Tick kWriteTime = 5;

inline std::string why_not_number(const std::string& name) {
  const bool is_number = name.size() == 2 && name.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? "" : "is not a number; expected 00 to 99";
}

inline std::string why_not_area(const std::string& name) {
  return name == "MAIN" || name == "ALARM" ? "" : "is not an area; expected MAIN or ALARM";
}

inline constexpr std::size_t kLongestFile = 8192;
inline constexpr BlockKind kBlocks[] = {
    {.name = "files", .max = 100, .longest = kLongestFile, .why_not_called = why_not_number},
    {.name = "recipes", .max = 10, .longest = 200, .why_not_called = why_not_number},
    {.name = "areas", .max = 2, .longest = 4096, .why_not_called = why_not_area}};

struct Kept {
  Eeprom eeprom;
  TextBlocks blocks;
  bool operator==(const Kept&) const = default;
};

inline Kept factory_persistent(const RegisterMap& map) {
  std::vector<std::uint32_t> factory;
  std::vector<std::uint8_t> kept;
  std::vector<std::uint8_t> at_once;
  for (const RegisterRow& row : map.rows()) {
    for (int i = 0; i < row.count && !row.is_view; ++i) {
      factory.push_back(static_cast<std::uint32_t>(row.factory));
      kept.push_back(row.persistent ? 1 : 0);
      at_once.push_back(row.needs_no_time ? 1 : 0);
    }
  }
  const auto as_bools = [](const std::vector<std::uint8_t>& given) {
    auto made = std::make_unique<bool[]>(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) made[i] = given[i] != 0;
    return made;
  };
  const auto is_persistent = as_bools(kept);
  const auto is_at_once = as_bools(at_once);
  return {.eeprom = Eeprom(factory, {is_persistent.get(), kept.size()}, {is_at_once.get(), at_once.size()}),
          .blocks = TextBlocks(kBlocks)};
}

/// Restores the stored values of the persistent registers at power-up.
inline void recall(const Eeprom& eeprom, const RegisterMap& map, std::vector<std::uint32_t>& image) {
  std::size_t slot = 0;
  for (const RegisterRow& row : map.rows()) {
    for (int i = 0; i < row.count && !row.is_view; ++i, ++slot) {
      if (row.persistent) image[slot] = eeprom.content()[slot];
    }
  }
}

class WorkbenchMemory final : public PersistentMemory {
 public:
  WorkbenchMemory(std::string_view model, Firmware firmware, RegisterBank& bank, Kept& kept)
      : PersistentMemory(model, firmware), bank_(bank), kept_(kept) {}

  TextBlocks* text_blocks() override { return &kept_.blocks; }
  const TextBlocks* text_blocks() const override { return &kept_.blocks; }
  std::uint64_t memory_revision() const override { return kept_.eeprom.revision() + kept_.blocks.revision(); }
  void settle_memory() override { kept_.eeprom.settle(bank_.image()); }

 protected:
  std::function<void(NvImage&)> memory_writer() const override {
    return registers_writer(bank_, kept_.eeprom.content());
  }
  void read_memory(const NvImage& image) override {
    const auto values = read_registers(bank_, image, 100);
    for (std::size_t slot = 0; slot < values.size(); ++slot) kept_.eeprom.put(slot, values[slot]);
  }

 private:
  RegisterBank& bank_;
  Kept& kept_;
};

/// One command on the line: its action (1 put, 2 append, 3 erase), kind, number, then two characters per
/// word.
inline Refusal change_block(TextBlocks& blocks, std::span<const std::uint16_t> words) {
  if (words.size() < 3 || words[0] < 1 || words[0] > 3 || words[1] >= std::size(kBlocks) || words[2] > 99) {
    return Refusal::bad_value;
  }
  const std::string_view kind = kBlocks[words[1]].name;
  const std::string name = std::to_string(100 + words[2]).substr(1);
  if (words[0] == 3) return blocks.erase(kind, name) ? Refusal::none : Refusal::bad_value;
  std::string text;
  const SharedText* const before = blocks.find(kind, name);
  if (words[0] == 2 && before != nullptr) text = before->text();
  for (const std::uint16_t word : words.subspan(3)) {
    for (const int shift : {8, 0}) {
      if (const auto byte = static_cast<char>(word >> shift & 0xFF); byte != 0) text += byte;
    }
  }
  return blocks.put(kind, name, SharedText(std::move(text))).empty() ? Refusal::none : Refusal::bad_value;
}

}  // namespace understudy::emulator::workbench

namespace understudy {

template <>
struct StateOf<emulator::workbench::Kept> {
  using Value = emulator::workbench::Kept;
  static constexpr auto fields = FieldList{field<&Value::eeprom>(), field<&Value::blocks>()};
};

}  // namespace understudy
