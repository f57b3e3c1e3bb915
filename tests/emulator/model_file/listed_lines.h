// Registers of lists as lines of text, for tests that compare whole lists.
#pragma once

#include <string>

#include "base/files/file_error.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/register_list.h"
#include "emulator/model_file/starter.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

using models::imported::ListedRegister;
using models::imported::WordOrder;

inline std::string type_text(const ListedRegister& listed) {
  std::string text = is_signed(listed.type) && listed.type != Type::f32 ? "s" : "u";
  if (listed.type == Type::f32) text = "f";
  if (listed.type == Type::bit) text = "bit";
  if (listed.is_bcd) text = "bcd";
  if (listed.type != Type::bit) text += std::to_string(width_of(listed.type));
  if (listed.order.words == WordOrder::Words::high_first) text += "hi";
  if (listed.order.words == WordOrder::Words::low_first) text += "lo";
  if (listed.order.low_byte_first) text += "sb";
  return text;
}

/// Returns the facts of a register in one line, without those that are usual: "40 SPEED u16 r 0..9 =1 rpm".
inline std::string line_of(const ListedRegister& listed) {
  std::string text;
  if (listed.table != Table::holding) text += std::string(to_string(listed.table)) + " ";
  text += std::to_string(listed.address) + " " + listed.name + " " + type_text(listed);
  if (listed.access == Access::read) text += " r";
  if (listed.access == Access::write) text += " w";
  if (listed.ranged)
    text += " " + value_text(listed.min, listed.type) + ".." + value_text(listed.max, listed.type);
  if (listed.factory != 0) text += " =" + value_text(listed.factory, listed.type);
  if (!listed.unit.empty()) text += " " + listed.unit;
  if (listed.persistent) text += " kept";
  for (const auto& bit : listed.bits)
    text += " " + bit.name + ":" + std::to_string(bit.bit) +
            (bit.width > 1 ? "+" + std::to_string(bit.width) : "");
  if (!listed.printed.empty()) text += " (" + listed.printed + ")";
  if (!listed.alias.empty()) text += " or " + listed.alias;
  return text;
}

/// Reads a list as `import` does.
inline RegisterList imported(const std::string& list, ListReading reading = {}) {
  reading.guesses_addresses = true;
  return read_list_file(list, "l.csv", reading);
}

inline std::string lines_in(const std::string& list, const ListReading& reading = {}) {
  std::string text;
  try {
    for (const ListedRegister& listed : imported(list, reading).registers) text += line_of(listed) + "\n";
  } catch (const FileError& error) {
    text = error.what();
  }
  return text;
}

inline std::string remarks_on(const std::string& list, const ListReading& reading = {}) {
  std::string text;
  for (const FileError::Diagnostic& remark : imported(list, reading).remarks.all())
    text += remark.text + "\n";
  return text;
}

struct Foreign {
  const char* list;
  const char* registers;
};

}  // namespace understudy::emulator::model_file
