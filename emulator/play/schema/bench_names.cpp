#include "emulator/play/schema/bench_names.h"

#include <cstddef>
#include <string>
#include <string_view>

#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/register_names.h"
#include "emulator/device/register_map/row.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/schema.h"
#include "emulator/world/names/names.h"
#include "emulator/world/view/bench_inventory.h"

namespace understudy::emulator::play {

namespace {

/// Returns the beginning of names as a regular expression. Device names may contain a hyphen, but no
/// character that has a special meaning in regular expressions.
std::string before_of(const world::KnownDevice& device, bool is_alone) {
  return is_alone ? "^(" + device.name + "\\.)?" : "^" + device.name + "\\.";
}

class Names {
 public:
  explicit Names(const world::KnownDevices& devices) : is_alone_(devices.size() == 1) {}

  void add(const world::KnownDevice& device, const std::string& name) {
    list.names.push_back(device.name + "." + name);
    if (is_alone_) list.names.push_back(name);
  }
  void add_register(const world::KnownDevice& device, const std::string& name, const std::string& meaning) {
    const std::size_t before = list.names.size();
    add(device, name);
    if (meaning.empty()) return;
    list.meanings.resize(before);
    list.meanings.resize(list.names.size(), meaning);
  }
  void add_pattern(const world::KnownDevice& device, const std::string& pattern) {
    list.patterns.push_back(before_of(device, is_alone_) + pattern + "$");
  }

  NameList list;

 private:
  bool is_alone_;
};

/// Escapes all characters that have a special meaning in regular expressions.
std::string escaped(std::string_view text) {
  std::string made;
  for (const char letter : text) {
    const bool is_plain = (letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z') ||
                          (letter >= 'a' && letter <= 'z') || letter == '_' || letter == ' ' || letter == '-';
    if (!is_plain) made += '\\';
    made += letter;
  }
  return made;
}

/// Returns a single expression for all names of a row's pattern, such as "VAR{}".
std::string names_of_pattern(std::string_view pattern) {
  const std::size_t hole = pattern.find("{}");
  if (hole == std::string_view::npos) return escaped(pattern);
  return escaped(pattern.substr(0, hole)) + "[A-Za-z0-9]+" + escaped(pattern.substr(hole + 2));
}

/// Returns the names of the registers that have bits. There are too many bits to list them.
std::string registers_with_bits(const RegisterMap& map) {
  std::string all;
  for (const RegisterRow& row : map.rows()) {
    if (row.type == Type::bit) continue;
    for (const std::string_view pattern : {row.name, row.alias}) {
      if (pattern.empty()) continue;
      all += (all.empty() ? "" : "|") + names_of_pattern(pattern);
      if (is_32_bit(row.type)) all += "(" + escaped(row.low_half) + "|" + escaped(row.high_half) + ")?";
    }
  }
  return "(" + all + ")";
}

/// Adds the spellings of a row's register, if this firmware has it.
void add_register(Names& names, const world::KnownDevice& device, const RegisterRow& row,
                  const std::string& name, const std::string& meaning) {
  const RegisterMap& map = *device.model->registers;
  std::string known = name;
  if (!map.find(known, device.firmware)) known = std::string(to_string(row.table)) + "." + name;
  if (!map.find(known, device.firmware)) return;
  names.add_register(device, known, meaning);
  for (const BitField& field : row.fields) {
    const std::string whole = known + "." + std::string(field.name);
    if (map.find(whole, device.firmware)) names.add_register(device, whole, meaning);
  }
}

void add_registers(Names& names, const world::KnownDevice& device) {
  if (device.model->registers == nullptr) return names.add_pattern(device, "[A-Za-z_][A-Za-z0-9_.]*");
  for (const RegisterRow& row : device.model->registers->rows()) {
    for (int index = 0; index < row.count; ++index) {
      for (const std::string_view pattern : {row.name, row.alias}) {
        if (pattern.empty()) continue;
        const bool is_of_the_first = row.count > 1 && pattern.find("{}") == std::string_view::npos;
        if (is_of_the_first && index > 0) continue;
        const std::string name = RegisterMap::name_of(row, index, pattern);
        const std::string meaning = meaning_of(row, index);
        add_register(names, device, row, name, meaning);
        if (!is_32_bit(row.type)) continue;
        add_register(names, device, row, name + std::string(row.low_half), meaning);
        add_register(names, device, row, name + std::string(row.high_half), meaning);
      }
    }
  }
  names.add_pattern(device, "((holding|input|coil|discrete)\\.)?(0x[0-9A-Fa-f]+|[0-9]+)(\\.[0-9]+)?");
  names.add_pattern(device,
                    "((holding|input)\\.)?" + registers_with_bits(*device.model->registers) + "\\.[0-9]+");
}

void add_inputs(Names& names, const world::KnownDevice& device) {
  for (const TerminalRow& row : device.model->terminals) {
    if (is_input(row.kind)) names.add(device, std::string(row.name));
  }
}

void add_axes(Names& names, const world::KnownDevice& device) {
  for (const AxisRow& row : device.model->axes) names.add(device, std::string(row.name));
}

}  // namespace

NameList bench_names(const world::Bench& bench, world::Schema::Of sort) {
  const world::BenchInventory inventory(bench);
  const world::KnownDevices& devices = inventory.known();
  Names names(devices);
  switch (sort) {
    case world::Schema::Of::anything: names.list.patterns.emplace_back(".*"); break;
    case world::Schema::Of::lines:
    case world::Schema::Of::devices_and_lines:
      for (std::size_t i = 0; i < inventory.line_count(); ++i)
        names.list.names.push_back(inventory.line_name(i));
      if (sort == world::Schema::Of::lines) break;
      [[fallthrough]];
    case world::Schema::Of::devices:
      for (const world::KnownDevice& device : devices) names.list.names.push_back(device.name);
      break;
    case world::Schema::Of::axes:
      for (const world::KnownDevice& device : devices) add_axes(names, device);
      break;
    case world::Schema::Of::inputs:
      for (const world::KnownDevice& device : devices) add_inputs(names, device);
      break;
    case world::Schema::Of::turned:
      for (const world::KnownDevice& device : devices) add_inputs(names, device);
      names.list.names.emplace_back("in");
      break;
    case world::Schema::Of::registers:
      for (const world::KnownDevice& device : devices) add_registers(names, device);
      if (!names.list.meanings.empty()) names.list.meanings.resize(names.list.names.size());
      break;
  }
  return names.list;
}

}  // namespace understudy::emulator::play
