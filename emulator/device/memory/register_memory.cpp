#include "emulator/device/memory/register_memory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/state/state_error.h"
#include "base/text/one_line.h"
#include "emulator/device/memory/nv_entry_error.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator {

namespace {

using List = NvEntryError::List;

/// Returns true if a register may contain a value. The value may be out of range if the policy stores any
/// value, or if half of a pair can be written alone. Reals that are not finite also pass, because an image
/// written by hand cannot contain them.
bool may_hold(const MapPolicy& policy, const RegisterRow& row, Value value) {
  const bool is_odd = row.type == Type::f32 && !std::isfinite(real_of(value));
  return is_odd || policy.out_of_range == MapPolicy::OutOfRange::stored ||
         (is_32_bit(row.type) && policy.halves != MapPolicy::Halves::come_whole) || is_in_range(row, value);
}

/// Returns true if a register can contain these bits: from a write, from the factory, or from the device
/// itself if hosts cannot write it.
bool can_hold(const MapPolicy& policy, const RegisterRow& row, std::uint32_t bits) {
  const Value value = value_of(bits, row.type);
  const auto whole = static_cast<std::uint32_t>(value);
  const bool fits = bits == whole || (width_of(row.type) == 16 && bits == (whole & 0xFFFFU));
  const bool is_written = row.access != Access::read;
  return fits && (bits & ~row.stored_bits) == 0 &&
         (!is_written || value == row.factory || may_hold(policy, row, value));
}

void write_persistent_registers(const RegisterMap& map, const std::vector<bool>& keeps_row,
                                const std::vector<std::uint32_t>& content, NvImage& image) {
  std::size_t slot = 0;
  std::size_t number = 0;
  for (const RegisterRow& row : map.rows()) {
    const bool is_persistent = keeps_row[number++];
    if (row.is_view) continue;
    for (int i = 0; i < row.count; ++i, ++slot) {
      if (!is_persistent || content[slot] == static_cast<std::uint32_t>(row.factory)) continue;
      const Value value = value_of(content[slot], row.type);
      std::string name = map.unique_name(row, i);
      // A real that is not finite is written as its bits.
      if (row.type == Type::f32 && std::isfinite(real_of(value))) {
        image.reals.emplace_back(std::move(name), real_of(value));
      } else {
        image.registers.emplace_back(std::move(name), value);
      }
    }
  }
}

}  // namespace

void check_restored_registers(const RegisterBank& bank, std::span<const std::uint32_t> image,
                              std::span<const std::uint32_t> content) {
  const auto slots = static_cast<std::size_t>(bank.map().slot_count());
  require_state(image.size() == slots && content.size() == slots, "the image has a different size");
  // This is the model's own policy: a choice in the bench may restrict what hosts write, but it does not
  // restrict programs.
  const MapPolicy& policy = bank.map().policy();
  std::size_t slot = 0;
  for (const RegisterRow& row : bank.map().rows()) {
    if (row.is_view) continue;
    const bool is_persistent = bank.keeps(row);
    for (int i = 0; i < row.count; ++i, ++slot) {
      // Without power, the image is blank except for later writes, and a worn-out register may be 0.
      const bool can_be = (image[slot] == 0 || can_hold(policy, row, image[slot])) &&
                          (!is_persistent || can_hold(policy, row, content[slot]));
      if (!can_be) throw StateError(bank.map().unique_name(row, i) + " holds a value that is not valid");
    }
  }
}

std::function<void(NvImage&)> registers_writer(const RegisterBank& bank,
                                               std::span<const std::uint32_t> content) {
  std::vector<bool> keeps_row;
  for (const RegisterRow& row : bank.map().rows()) keeps_row.push_back(bank.keeps(row));
  return [&map = bank.map(), keeps_row = std::move(keeps_row),
          values = std::vector<std::uint32_t>(content.begin(), content.end())](NvImage& image) {
    write_persistent_registers(map, keeps_row, values, image);
  };
}

std::vector<std::uint32_t> read_registers(const RegisterBank& bank, const NvImage& image, Firmware newest) {
  const RegisterMap& map = bank.map();
  const auto rows = map.rows();
  const bool has_reals =
      std::any_of(rows.begin(), rows.end(), [](const RegisterRow& row) { return row.type == Type::f32; });
  for (const auto& [key, is_present] : {std::pair("reals", !image.reals.empty() && !has_reals),
                                        std::pair("program", !image.program.empty())}) {
    if (!is_present) continue;
    throw NvError(std::string(key) + ": is not part of the memory of " + image.model + "; expected none");
  }
  std::vector<std::uint32_t> values;
  for (const RegisterRow& row : rows) {
    if (row.is_view) continue;
    values.insert(values.end(), static_cast<std::size_t>(row.count), static_cast<std::uint32_t>(row.factory));
  }
  std::vector<bool> is_named(values.size(), false);
  auto entries = image.registers;
  for (const auto& [name, real] : image.reals) {
    const auto found = map.find(name, newest);
    if (!found) throw refused_value(List::reals, name, map.why_not(name, newest));
    const auto value = value_of_number(*found, real);
    if (!found->is_real() || !value) {
      throw refused_value(
          List::reals, name,
          quoted(name) + " cannot hold this number; expected " + range_text(*found->place.row));
    }
    entries.emplace_back(name, *value);
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& [name, value] = entries[i];
    const List list = i < image.registers.size() ? List::registers : List::reals;
    const auto found = map.find(name, newest);
    if (!found || found->bit >= 0 || found->place.part != Place::Part::whole) {
      throw refused_value(list, name, map.why_not(name, newest));
    }
    const RegisterRow& row = *found->place.row;
    if (!bank.keeps(row)) {
      throw refused_value(list, name, quoted(name) + " is not persistent; expected a persistent register");
    }
    const auto bits = static_cast<std::uint32_t>(value);
    const bool in_range = may_hold(bank.map_policy(), row, value_of(bits, row.type));
    if (value_of(bits, row.type) != value || (bits & row.stored_bits) != bits || !in_range) {
      throw refused_value(
          list, name,
          quoted(name) + ": " + value_text(value, row.type) + " does not fit; expected " + range_text(row));
    }
    const auto slot = static_cast<std::size_t>(found->place.slot);
    if (is_named[slot]) {
      throw refused_value(list, name,
                          quoted(name) + ": appears twice, under two names; expected it only once");
    }
    is_named[slot] = true;
    values[slot] = bits;
  }
  return values;
}

}  // namespace understudy::emulator
