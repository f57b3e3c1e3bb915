#include "emulator/model_file/starter.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_fields.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_text.h"
#include "emulator/model_file/list_words.h"
#include "emulator/model_file/register_list.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

using models::imported::ListedRegister;

namespace {

/// A key of an axis, and the words that makers use for the corresponding register.
struct Guess {
  std::string_view key;
  bool is_written = true;  // true if hosts write the register
  std::array<std::string_view, 4> words{};
  std::string_view suffix{};  // follows the name, such as a bit
  std::string_view otherwise;
  std::string_view meaning;
};
constexpr std::array<Guess, 9> kGuesses{
    {{"target",
      true,
      {"target", "setpos", "position_set", "destination"},
      "",
      "TARGET",
      "the target of `start`"},
     {"speed", true, {"speed", "velocity", "frequency", "rpm"}, "", "SPEED", "how fast"},
     {"acceleration_time", true, {"acc", "ramp"}, "", "250ms", "a register that holds a time, or a duration"},
     {"start",
      true,
      {"start", "control", "command", "trigger"},
      ".0",
      "CONTROL.0",
      "a bit that comes on, or COMMAND == 1"},
     {"stop", true, {"stop", "control", "command"}, ".1", "CONTROL.1", "slows down to a stop"},
     {"position", false, {"position", "pos", "count"}, "", "POSITION", "shows its position"},
     {"busy", false, {"busy", "status", "moving", "running"}, ".0", "STATUS.0", "1 while it moves"},
     {"arrived", false, {"arrived", "in_position", "status", "done"}, ".1", "STATUS.1", "1 at the target"},
     {"actual_speed",
      false,
      {"speed", "velocity", "frequency", "rpm"},
      "",
      "ACTUAL_SPEED",
      "shows its speed"}}};

const ListedRegister* find_likely(const std::vector<ListedRegister>& registers, const Guess& guess) {
  for (const std::string_view word : guess.words) {
    if (word.empty()) continue;
    for (const ListedRegister& listed : registers) {
      const bool suits = guess.is_written ? listed.access != Access::read : listed.access == Access::read;
      if (suits && lower(listed.name).find(word) != std::string::npos) return &listed;
    }
  }
  return nullptr;
}

std::string guessed(const std::vector<ListedRegister>& registers, const Guess& guess) {
  const ListedRegister* const likely = find_likely(registers, guess);
  if (likely == nullptr) return std::string(guess.otherwise);
  return likely->name + (likely->type == Type::bit ? "" : std::string(guess.suffix));
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

/// Returns the line `firmware: [...]` if some registers exist only from a later version on.
std::string firmwares_of(const std::vector<ListedRegister>& registers) {
  std::set<Firmware> all;
  for (const ListedRegister& listed : registers) all.insert(listed.since);
  all.erase(0);
  if (all.empty()) return "";
  constexpr Firmware kOldest = 100;
  std::string text = "firmware: [";
  if (*all.begin() > kOldest) text += " '" + version_text(kOldest) + "',";
  for (const Firmware version : all) text += " '" + version_text(version) + "',";
  text.back() = ' ';
  return text + "]  # the oldest first\n";
}

}  // namespace

RegisterList read_list_file(const std::string& bytes, const std::string& path, const ListReading& reading) {
  world::Diagnostics diagnostics;
  RegisterList list;
  diagnostics.require([&] {
    Remarks remarks;
    const std::string text = decode_list(bytes, reading.encoding, {.file = path}, remarks);
    list = read_register_list(text, {.file = path}, reading, diagnostics);
    list.remarks.add(remarks);
  });
  return list;
}

std::string starter_model(const RegisterList& list, const ListReading& reading, const std::string& name,
                          const std::string& list_path) {
  const std::vector<ListedRegister>& registers = list.registers;
  const bool has_pairs = std::any_of(registers.begin(), registers.end(),
                                     [](const auto& listed) { return is_32_bit(listed.type); });
  std::string text =
      "# A model made from a list of registers. It stores what hosts write, within the ranges of the\n# "
      "list. docs/import.md has all keys; `understudy check` reports mistakes.\nunderstudy: 1\nmodel: " +
      name +
      "\n"
      "title: my controller\n"
      "registers: " +
      quoted_yaml(list_path) + "\n" + firmwares_of(registers) + list_section(reading, list.addresses) +
      "line:\n"
      "  baud: [19200, 9600]  # the factory setting first\n"
      "  parity: none\n"
      "  stop_bits: 1\n"
      "  stations: [1, 247]\n"
      "map:\n"
      "  out_of_range: refused  # or clamped, stored\n"
      "  holes: refused         # or zero\n";
  if (has_pairs)
    text +=
        "  first_word: high       # of 32-bit values; or low\n"
        "  halves: alone          # without regard to the range; or judged, whole\n";
  text +=
      "\n"
      "# An axis that moves: remove the # signs, and fill in your registers.\n"
      "#axes:\n"
      "#  A:\n";
  for (const Guess& guess : kGuesses) {
    text += padded("#    " + std::string(guess.key) + ": " + guessed(registers, guess), 44) + "  # " +
            std::string(guess.meaning) + "\n";
  }
  text +=
      "\n"
      "# A value that follows another one, as a temperature follows its setpoint.\n"
      "#follows:\n"
      "#  TEMPERATURE: { of: SETPOINT, time_constant: 30s }\n";
  return text;
}

std::string starter_bench(const std::string& name, const std::string& model_path, int station) {
  return "understudy: 1\n"
         "lines:\n"
         "  line:\n"
         "    link: ./" +
         name +
         ".port\n"
         "    stations:\n"
         "      - { name: " +
         name + ", model: " + quoted_yaml(model_path) + ", address: " + std::to_string(station) + " }\n";
}

}  // namespace understudy::emulator::model_file
