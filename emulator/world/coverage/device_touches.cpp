#include "emulator/world/coverage/device_touches.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/command_window.h"
#include "emulator/device/decisions.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/program_language.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/transition_table.h"
#include "emulator/device/user_program.h"
#include "emulator/world/faults/kinds.h"
#include "emulator/world/protocol/modbus_request.h"
#include "emulator/world/protocol/modbus_words.h"
#include "emulator/world/stations/server.h"

namespace understudy::emulator::world {

namespace {

enum Column : std::size_t { kRead, kWritten, kRefused };
enum BitColumn : std::size_t { kOn, kOff };
enum Outcome : std::size_t { kAccepted, kNotAccepted };
enum Motion : std::size_t { kStanding, kMoving };

// Every device can answer with these exceptions. Other exceptions get a row when they occur.
constexpr int kExceptions[] = {1, 2, 3};

void count(std::int64_t& counter) { counter = std::max<std::int64_t>(counter, 0) + 1; }

std::string name_of(const RegisterMap& map, const RegisterRow& row) {
  const std::string first = map.unique_name(row, 0);
  return row.count == 1 ? first : first + " to " + RegisterMap::name_of(row, row.count - 1);
}

/// Returns true if the bits of the register are counted separately, because they have names or because there
/// is only one bit.
bool has_bits(const RegisterRow& row) {
  return row.access != Access::write && (!row.fields.empty() || (row.type == Type::bit && row.count == 1));
}

std::string function_name(std::uint8_t code) {
  for (const FunctionRow& row : kModbusFunctions) {
    if (row.code != code) continue;
    const char* const does = row.kind == FunctionRow::Kind::read        ? "read "
                             : row.kind == FunctionRow::Kind::write_one ? "write one "
                                                                        : "write several ";
    return std::to_string(code) + " " + does + std::string(to_string(row.table));
  }
  return std::to_string(code);
}

/// Returns true if the word matches the pattern. In a pattern such as "TpMA", p stands for the number of a
/// module.
bool is_called(std::string_view pattern, std::string_view word) {
  if (pattern.size() > word.size()) return false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const bool is_number = pattern[i] == 'p' && std::isdigit(static_cast<unsigned char>(word[i])) != 0;
    if (!is_number && pattern[i] != word[i]) return false;
  }
  return true;
}

/// Returns the instructions that a program can contain, without the commands of a window.
std::vector<const InstructionRow*> program_rows(const Model& model) {
  std::vector<const InstructionRow*> rows;
  if (model.language == nullptr) return rows;
  for (const InstructionRow& row : model.language->instructions()) {
    const bool is_sent = model.window != nullptr && row.areas.find(model.window->area()) != row.areas.npos;
    if (!is_sent) rows.push_back(&row);
  }
  return rows;
}

}  // namespace

DeviceTouches::DeviceTouches(const Device& device) : device_(device) {
  add_registers();
  add_functions();
  add_commands();
  device.decisions().begin();
  for (const FaultKindRow& kind : fault_kinds()) {
    faults_.rows.push_back({.name = std::string(kind.name), .counts = {0, 0}});
  }
}

void DeviceTouches::add_registers() {
  const RegisterBank* const bank = device_.register_bank();
  if (bank == nullptr) return;
  std::set<const RegisterRow*> shows_state;
  for (const std::string_view name : device_.model().state_registers) {
    if (const auto named = bank->find(name)) shows_state.insert(named->place.row);
  }
  for (const RegisterRow& row : bank->map().rows()) {
    const bool is_present = bank->has_row(row);
    const bool is_read = is_present && row.access != Access::write && row.message == nullptr;
    const bool is_written = is_present && row.access != Access::read;
    const bool matters = shows_state.contains(&row);
    registers_.rows.push_back({.name = name_of(bank->map(), row),
                               .counts = {is_read ? 0 : kCannotBe, is_written ? 0 : kCannotBe, kCannotBe},
                               .matters_most = matters});
    first_bits_.push_back(bits_.rows.size());
    if (!is_present || !has_bits(row)) continue;
    const std::string& name = registers_.rows.back().name;
    if (row.type == Type::bit) {
      bits_.rows.push_back({.name = name, .counts = {0, 0}, .matters_most = matters});
      continue;
    }
    for (const BitField& field : row.fields) {
      bits_.rows.push_back(
          {.name = name + "." + std::string(field.name), .counts = {0, 0}, .matters_most = matters});
    }
  }
}

void DeviceTouches::add_functions() {
  const Model& model = device_.model();
  if (!model.rtu) return;
  for (const std::uint8_t code : model.rtu->functions) {
    functions_.rows.push_back({.name = function_name(code), .counts = {0, 0}});
  }
  for (const int exception : kExceptions) {
    exceptions_.rows.push_back({.name = exception_text(exception), .counts = {0}});
  }
}

void DeviceTouches::add_commands() {
  const Model& model = device_.model();
  std::set<std::string_view> known;
  const auto add = [&](std::string_view name) {
    if (known.insert(name).second) commands_.rows.push_back({.name = std::string(name), .counts = {0, 0}});
  };
  for (const CommandRow& row : model.commands) {
    if (row.where.empty() || row.where.find("typed") != row.where.npos) add(row.command);
  }
  if (model.window == nullptr || model.language == nullptr) return;
  for (const InstructionRow& row : model.language->instructions()) {
    if (row.areas.find(model.window->area()) != row.areas.npos) add(row.mnemonic);
  }
}

/// Counts each row that overlaps the span once.
void DeviceTouches::touch(const RegisterSpan& span, std::size_t column) {
  if (device_.register_bank() == nullptr) return;
  const RegisterBank& bank = *device_.register_bank();
  const Table table = table_in(bank, span.table);
  const RegisterRow* before = nullptr;
  for (std::size_t i = 0; i < span.count; ++i) {
    const Place place = bank.at(table, static_cast<std::uint16_t>(span.first + i));
    if (!place || place.row == before) continue;
    before = place.row;
    count(registers_.rows[static_cast<std::size_t>(place.row - bank.map().rows().data())].counts[column]);
  }
}

void DeviceTouches::see(const Place& place, std::uint16_t word) {
  if (!has_bits(*place.row)) return;
  const RegisterMap& map = device_.register_bank()->map();
  std::size_t row = first_bits_[static_cast<std::size_t>(place.row - map.rows().data())];
  if (place.row->type == Type::bit) return count(bits_.rows[row].counts[word != 0 ? kOn : kOff]);
  const std::uint32_t half = place.part == Place::Part::high ? std::uint32_t{word} << 16U : word;
  const std::uint32_t seen = place.part == Place::Part::high ? 0xFFFF'0000U : 0xFFFFU;
  for (const BitField& field : place.row->fields) {
    if ((field.mask() & seen) != 0) count(bits_.rows[row].counts[(half & field.mask()) != 0 ? kOn : kOff]);
    ++row;
  }
}

void DeviceTouches::answered(const ModbusRequest& request, std::span<const std::uint8_t> data) {
  count(functions_.row(function_name(request.function)).counts[kAccepted]);
  if (request.writes) {
    touch(*request.writes, kWritten);
    send_command(*request.writes, request.words, false);
  }
  if (!request.reads || device_.register_bank() == nullptr) return;
  touch(*request.reads, kRead);
  const RegisterBank& bank = *device_.register_bank();
  const Table table = table_in(bank, request.reads->table);
  const bool are_bits = is_table_of_bits(table);
  for (std::size_t i = 0; i < request.reads->count; ++i) {
    const std::size_t byte = are_bits ? i / 8 : 2 * i;
    if (byte + (are_bits ? 0 : 1) >= data.size()) return;
    const Place place = bank.at(table, static_cast<std::uint16_t>(request.reads->first + i));
    if (!place) continue;
    see(place,
        static_cast<std::uint16_t>(are_bits ? data[byte] >> i % 8 & 1 : data[byte] << 8 | data[byte + 1]));
  }
}

void DeviceTouches::refused(const ModbusRequest& request, std::optional<int> exception) {
  count(functions_.row(function_name(request.function)).counts[kNotAccepted]);
  if (exception) count(exceptions_.row(exception_text(*exception)).counts[0]);
  if (request.reads) touch(*request.reads, kRefused);
  if (!request.writes) return;
  touch(*request.writes, kRefused);
  send_command(*request.writes, request.words, true);
}

void DeviceTouches::written(Table table, std::uint16_t first, std::span<const std::uint16_t> words) {
  const RegisterSpan span{.table = table, .first = first, .count = words.size()};
  touch(span, kWritten);
  send_command(span, words, false);
}

/// If the words are a command, counts it.
void DeviceTouches::send_command(const RegisterSpan& span, std::span<const std::uint16_t> words,
                                 bool is_refused) {
  if (words.empty()) return;
  const auto text = window_text(device_, span.table, span.first, words);
  if (text) command(*text, is_refused);
}

/// Returns the longest command name with which the text begins: "MA" for "MA 1000".
std::string DeviceTouches::command_called(std::string_view text) const {
  const TouchedRow* longest = nullptr;
  for (const TouchedRow& row : commands_.rows) {
    const bool is_longer = longest == nullptr || row.name.size() > longest->name.size();
    if (is_longer && is_called(row.name, text)) longest = &row;
  }
  return longest == nullptr ? std::string() : longest->name;
}

void DeviceTouches::command(std::string_view text, bool is_refused) {
  const std::string name = command_called(text);
  if (!name.empty()) count(commands_.row(name).counts[is_refused ? kNotAccepted : kAccepted]);
}

void DeviceTouches::fault(Fault::Kind kind, bool is_moving) {
  count(faults_.rows[static_cast<std::size_t>(kind)].counts[is_moving ? kMoving : kStanding]);
}

namespace {

/// Returns the program instructions with their execution counts.
TouchedTable instruction_table(const Model& model, const std::map<std::string, CoveredLine>& instructions) {
  TouchedTable table{.name = "instructions", .columns = {"run", "yes", "no"}};
  for (const InstructionRow* const row : program_rows(model)) {
    const auto counts = [&]() -> std::vector<std::int64_t> {
      auto found = instructions.find(std::string(row->mnemonic));
      if (found == instructions.end() && row->opcode) found = instructions.find(std::to_string(*row->opcode));
      if (found == instructions.end()) return {0, kCannotBe, kCannotBe};
      const CoveredLine& line = found->second;
      return {line.runs, line.decides ? line.yes : kCannotBe, line.decides ? line.no : kCannotBe};
    }();
    table.rows.push_back({.name = std::string(row->mnemonic), .counts = counts});
  }
  return table;
}

TouchedTable transition_table(const Device& device, std::size_t number) {
  const TransitionTable& cells = device.model().transitions[number];
  TouchedTable table{.name = std::string(cells.name), .columns = cells.events};
  for (std::size_t state = 0; state < cells.states.size(); ++state) {
    TouchedRow row{.name = cells.states[state], .counts = {}};
    for (std::size_t event = 0; event < cells.events.size(); ++event) {
      const std::int64_t met = device.decisions().met(number, state, event);
      const bool can_occur = cells.can_occur == nullptr || cells.can_occur(state, event) || met > 0;
      row.counts.push_back(can_occur ? met : kCannotBe);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Counts 1 for each choice that the device has looked up, and 0 for the others. If the device stores the
/// option of a choice, the choice has no count, because its use cannot be observed.
TouchedTable choice_table(const Device& device) {
  TouchedTable table{.name = "choices", .columns = {"asked"}};
  const auto& rows = device.model().choices;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool has_alternative = rows[i].options.find('|') != std::string_view::npos;
    const bool is_kept = device.decisions().was_asked_before(i);
    const std::int64_t asked = device.decisions().is_asked(i) ? 1
                               : is_kept || !has_alternative  ? kCannotBe
                                                              : 0;
    table.rows.push_back({.name = std::string(rows[i].id), .counts = {asked}});
  }
  return table;
}

void drop_empty_rows(TouchedTable& table) {
  std::erase_if(table.rows, [](const TouchedRow& row) {
    return std::all_of(row.counts.begin(), row.counts.end(),
                       [](std::int64_t counted) { return counted == kCannotBe; });
  });
}

}  // namespace

TouchedModel DeviceTouches::tables(const std::map<std::string, CoveredLine>& instructions) const {
  TouchedModel tables{bits_, functions_, exceptions_, commands_, registers_, faults_};
  for (std::size_t i = 0; i < device_.model().transitions.size(); ++i) {
    tables.push_back(transition_table(device_, i));
  }
  tables.push_back(instruction_table(device_.model(), instructions));
  tables.push_back(choice_table(device_));
  for (TouchedTable& table : tables) drop_empty_rows(table);
  std::erase_if(tables, [](const TouchedTable& table) { return table.rows.empty(); });
  return tables;
}

}  // namespace understudy::emulator::world
