#include "emulator/models/rs_m8194h/programs/memory.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/text/lines.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/rows/registers.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/listing.h"
#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/text_error.h"
#include "interpreter/rs_m8194h/triggers.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// A macro of 512 lines is shorter than this, even with the longest command.
constexpr std::size_t kLongestMacro = 100'000;
constexpr std::size_t kLongestLine = 200;
constexpr std::size_t kLongestTable = 4'000;

std::string why_not_number(const std::string& name, int max) {
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool is_number = error == std::errc{} && end == name.data() + name.size() && number >= 1 &&
                         number <= max && std::to_string(number) == name;
  return is_number ? "" : "is not a macro number; expected 1 to " + std::to_string(max);
}
std::string why_not_mp(const std::string& name) { return why_not_number(name, lang::kMpCount); }
std::string why_not_isr(const std::string& name) { return why_not_number(name, lang::kIsrCount); }
std::string why_not_channel(const std::string& name) {
  for (int channel = 0; channel < lang::kTriggerCount; ++channel) {
    if (lang::text_of_channel(channel) == name) return "";
  }
  return "is not an input; expected 8.0 to 15.15";
}
std::string why_not_axis(const std::string& name) {
  for (const std::string_view axis : kAxisNames) {
    if (axis == name) return "";
  }
  return "is not an axis; expected X, Y, Z or U";
}
std::string why_not_listing(const std::string& text) {
  const lang::ParsedListing parsed = lang::parse_listing(text, lang::kAnyChoice);
  return parsed.errors.empty() ? "" : "line " + to_string(parsed.errors.front());
}
std::string why_not_settings(const std::string& text) {
  for (const TextLine line : TextLines(text)) {
    const lang::ParsedCommand parsed = lang::parse_command(line.text);
    if (!parsed.command || !parsed.command->row().use.initial) {
      return "line " + std::to_string(line.number) + ": is not a setting of the Initial Table";
    }
  }
  return "";
}

constexpr BlockKind kKinds[] = {
    {.name = kInitialBlocks,
     .max = kAxes,
     .longest = kLongestTable,
     .why_not_called = why_not_axis,
     .why_not_text = why_not_settings},
    {.name = kIsrBlocks,
     .max = lang::kIsrCount,
     .longest = kLongestMacro,
     .why_not_called = why_not_isr,
     .why_not_text = why_not_listing},
    {.name = kMpBlocks,
     .max = lang::kMpCount,
     .longest = kLongestMacro,
     .why_not_called = why_not_mp,
     .why_not_text = why_not_listing},
    {.name = kTriggerBlocks,
     .max = lang::kTriggerCount,
     .longest = kLongestLine,
     .why_not_called = why_not_channel,
     .why_not_text = why_not_listing},
};

}  // namespace

std::span<const BlockKind> block_kinds() { return kKinds; }

bool Memory::keeps(const RegisterRow& row) const {
  constexpr Addresses kEvent = addresses_of(Table::holding, "FRnet Event");
  constexpr Addresses kWordOrder = addresses_of(Table::holding, "WORD Order");
  constexpr Addresses kBvarAddresses = addresses_of(Table::holding, "bVAR{}");
  const auto is_in = [&](const Addresses& some) { return some.has(row.table, row.address); };
  if (is_in(kEvent)) return chose(option("trigger_enable_kept", "kept"));
  if (is_in(kWordOrder)) return chose(option("word_order_kept", "kept"));
  const bool is_variable = is_in(kBvarAddresses) || is_in(kVarAddresses);
  return row.persistent || (is_variable && chose(option("variables_kept", "kept")));
}

Eeprom Memory::factory_memory() const {
  std::vector<std::uint32_t> factory;
  const auto is_persistent = std::make_unique<bool[]>(kSlotCount);
  const auto at_once = std::make_unique<bool[]>(kSlotCount);
  for (const RegisterRow& row : kRegisters) {
    for (int i = 0; i < row.count && !row.is_view; ++i) {
      // Persistent values are stored without delay.
      is_persistent[factory.size()] = at_once[factory.size()] = keeps(row);
      factory.push_back(static_cast<std::uint32_t>(row.factory));
    }
  }
  return Eeprom(factory, {is_persistent.get(), kSlotCount}, {at_once.get(), kSlotCount});
}

std::vector<std::uint32_t> Memory::image_at_power_up() const {
  const std::span<const std::uint32_t> kept = state_.eeprom.content();
  std::vector<std::uint32_t> image(kSlotCount);
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    if (row.is_view) continue;
    const bool is_persistent = keeps(row);
    for (int i = 0; i < row.count; ++i, ++next) {
      image[next] =
          is_persistent && next < kept.size() ? kept[next] : static_cast<std::uint32_t>(row.factory);
    }
  }
  return image;
}

void Memory::put(std::size_t slot, std::uint32_t bits) {
  state_.image[slot] = bits;
  state_.eeprom.write(slot, bits, 0, now());
}

void Memory::clear(std::size_t first, std::size_t count) {
  for (std::size_t slot = first; slot < first + count; ++slot) put(slot, 0);
}

void Memory::register_written(const RegisterRow& row, std::size_t slot) {
  if (keeps(row)) state_.eeprom.write(slot, state_.image[slot], 0, now());
}

BasicSettings Memory::factory_settings() const {
  // The soft limits and the ring in figure 3 are switched off.
  if (!chose(option("factory_values", "of_figure_3"))) return {};
  return {.max_v = 8'000, .filtered = 1, .filter_time = 2};
}

void Memory::keep_initial_table() {
  rs_m8194h::keep_initial_table(state_.blocks, state_.initial_table, factory_settings());
}

}  // namespace understudy::emulator::models::rs_m8194h
