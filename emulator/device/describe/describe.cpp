#include "emulator/device/describe/describe.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/choices.h"
#include "emulator/device/describe/sheet.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/model.h"
#include "emulator/device/program_language.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/register_names.h"
#include "emulator/device/register_map/row.h"
#include "pty/line_settings.h"

namespace understudy::emulator {

namespace {

std::string hex4(unsigned number) {
  std::array<char, 12> text{};
  std::snprintf(text.data(), text.size(), "0x%04X", number);
  return text.data();
}

std::string hex2(unsigned number) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "0x%02X", number);
  return text.data();
}

/// Formats an opcode with as many digits as the maker's manual uses.
std::string opcode_text(int opcode) {
  return opcode > 0xFF ? hex4(static_cast<unsigned>(opcode)) : hex2(static_cast<unsigned>(opcode));
}

std::string_view to_string(Access access) {
  switch (access) {
    case Access::read: return "R";
    case Access::write: return "W";
    case Access::read_write: return "R/W";
  }
  return "";
}

std::uint16_t address_of(const RegisterRow& row, int index) {
  return static_cast<std::uint16_t>(row.address + index * row.stride);
}

/// Returns the English name of a section, or the section itself if its name in the manual is already English.
std::string_view section_in_english(const Model& model, std::string_view section) {
  for (const SectionRow& row : model.sections) {
    if (row.name == section) return row.in_english;
  }
  return section;
}

/// Returns a section with its English name: "狀態相關 (status)".
std::string section_for_people(const Model& model, std::string_view section) {
  const std::string_view english = section_in_english(model, section);
  return std::string(section) + (english == section ? "" : " (" + std::string(english) + ")");
}

std::string width_of(const RegisterRow& row) { return std::to_string(emulator::width_of(row.type)); }

/// Returns the number that many manuals and tools use for a register: 40001 is holding register 0, and 410001
/// is holding register 10000.
std::string modicon_number(Table table, int address) {
  constexpr int kMaxOfFiveDigits = 9998;
  const int digits = address > kMaxOfFiveDigits ? 6 : 5;
  const std::string number = std::to_string(address + 1);
  const std::string_view first = table == Table::holding    ? "4"
                                 : table == Table::input    ? "3"
                                 : table == Table::discrete ? "1"
                                                            : "0";
  return std::string(first) + std::string(static_cast<std::size_t>(digits) - 1 - number.size(), '0') + number;
}

/// Returns the named bits of a register: "0 READY, 4-7 STATE".
std::string fields_of(const RegisterRow& row) {
  std::string text;
  for (const BitField& field : row.fields) {
    text += (text.empty() ? "" : ", ") + std::to_string(field.bit);
    if (field.width > 1) text += "-" + std::to_string(field.bit + field.width - 1);
    text += " " + std::string(field.name);
  }
  return text;
}

/// Returns the byte order of a register on the line: "abcd" has the high word first.
std::string_view order_text(const RegisterRow& row, const MapPolicy& policy) {
  const bool low_first = row.swaps_words != policy.low_word_first;
  if (row.swaps_bytes) return low_first ? "dcba" : "badc";
  return low_first ? "cdab" : "abcd";
}

/// Returns "1" if the register is persistent, otherwise "0". In the table for people, returns "at once" if
/// storing takes no time.
std::string kept_text(const RegisterRow& row, bool for_people) {
  if (for_people && row.needs_no_time) return "at once";
  return row.persistent ? "1" : "0";
}

template <typename Holds>
bool any_row(const Model& model, Holds holds) {
  const auto rows = register_rows(model);
  return std::any_of(rows.begin(), rows.end(), holds);
}

bool has_meaning(const RegisterRow& row) { return !row.meaning.in_english.empty() || !row.meanings.empty(); }

/// Returns true if the sheets of registers and parameters contain the meaning of each row. In CSV, the
/// columns of registers are those that `import` reads.
bool shows_meanings(const Model& model, SheetFormat format) {
  return format != SheetFormat::csv && any_row(model, has_meaning);
}

Sheet registers(const Model& model, SheetFormat format) {
  const bool for_people = format == SheetFormat::table;
  Sheet sheet{.columns = {"table", "address", "name", "access", "width", "signed", "min", "max", "unit",
                          "persistent", "default"},
              .rows = {}};
  if (for_people) {
    for (const char* column : {"Modicon", "since", "section", "not modelled"})
      sheet.columns.emplace_back(column);
  }
  // Only some models need these columns.
  const bool has_reals = any_row(model, [](const RegisterRow& row) { return row.type == Type::f32; });
  const bool may_have_fields = model.csv_has_bits || format != SheetFormat::csv;
  const bool has_fields =
      may_have_fields && any_row(model, [](const RegisterRow& row) { return !row.fields.empty(); });
  if (has_reals) sheet.columns.emplace_back("real");
  const bool has_orders =
      any_row(model, [](const RegisterRow& row) { return row.swaps_words || row.swaps_bytes; });
  if (has_fields) sheet.columns.emplace_back("bits");
  if (has_orders) sheet.columns.emplace_back("order");
  const bool has_meanings = shows_meanings(model, format);
  if (has_meanings) {
    for (const char* column : {"meaning", "heading"}) sheet.columns.emplace_back(column);
  }
  for (const RegisterRow& row : register_rows(model)) {
    for (int index = 0; index < row.count; ++index) {
      sheet.rows.push_back(
          {std::string(to_string(row.table)), hex4(address_of(row, index)), RegisterMap::name_of(row, index),
           std::string(to_string(row.access)), width_of(row), is_signed(row.type) ? "1" : "0",
           row.ranged ? value_text(row.min, row.type) : "", row.ranged ? value_text(row.max, row.type) : "",
           std::string(row.unit), kept_text(row, for_people), value_text(row.factory, row.type)});
      auto& cells = sheet.rows.back();
      if (for_people) {
        cells.push_back(modicon_number(row.table, address_of(row, index)));
        cells.push_back(row.since == 0 ? "" : version_text(row.since));
        cells.push_back(section_for_people(model, row.section));
        cells.emplace_back(row.not_implemented);
      }
      if (has_reals) cells.emplace_back(row.type == Type::f32 ? "1" : "0");
      if (has_fields) cells.push_back(fields_of(row));
      if (has_orders) cells.emplace_back(order_text(row, model.registers->policy()));
      if (has_meanings) {
        cells.push_back(meaning_of(row, index));
        cells.push_back(heading_of(row, index));
      }
    }
  }
  return sheet;
}

/// Returns "X20", or "20" if the maker numbers parameters without a letter.
std::string number_of(const ParameterRow& row, int index) {
  return std::string(row.letter) + std::to_string(row.first + (row.of_each_axis ? 0 : index));
}

/// Lists the parameters. If they are registers, their other properties are in the register table.
Sheet parameters(const Model& model, SheetFormat format) {
  const bool has_named = !model.named_parameters.empty();
  const bool has_meanings = shows_meanings(model, format);
  Sheet sheet{.columns = {"number", "name", "address", "width", "persistent"}, .rows = {}};
  if (has_named) {
    for (const char* column : {"min", "max", "unit", "default"}) sheet.columns.emplace_back(column);
  }
  if (has_named || has_meanings) sheet.columns.emplace_back("meaning");
  if (has_named) sheet.columns.emplace_back("not modelled");
  for (const NamedParameterRow& row : model.named_parameters) {
    sheet.rows.push_back({std::string(row.number), std::string(row.name), "", std::to_string(row.width),
                          row.persistent ? "1" : "0"});
    for (const std::string_view cell : {std::string_view(row.min), std::string_view(row.max), row.unit,
                                        std::string_view(row.factory), row.meaning, row.not_implemented}) {
      sheet.rows.back().emplace_back(cell);
    }
  }
  for (const ParameterRow& parameter : model.parameters) {
    for (const RegisterRow& row : register_rows(model)) {
      if (row.name != parameter.register_name) continue;
      for (int i = 0; i < (parameter.of_each_axis ? row.count : parameter.count); ++i) {
        sheet.rows.push_back({number_of(parameter, i), RegisterMap::name_of(row, i), hex4(address_of(row, i)),
                              width_of(row), row.persistent ? "1" : "0"});
        if (has_named) sheet.rows.back().resize(sheet.columns.size() - 2);
        if (has_named || has_meanings) sheet.rows.back().push_back(meaning_of(row, i));
        sheet.rows.back().resize(sheet.columns.size());
      }
    }
  }
  return sheet;
}

/// Returns "target (D0 to D124); [speed (1 to 4000)]".
std::string operands_text(std::span<const OperandRow> operands) {
  std::string text;
  for (const OperandRow& operand : operands) {
    const std::string values(operand.values);
    const std::string whole = operand.name.empty() ? values : std::string(operand.name) + " (" + values + ")";
    text += (text.empty() ? "" : "; ") + (operand.may_be_unset ? "[" + whole + "]" : whole);
  }
  return text;
}

Sheet instructions(const Model& model) {
  const auto rows =
      model.language == nullptr ? std::span<const InstructionRow>() : model.language->instructions();
  const auto in_cells =
      model.language == nullptr ? std::span<const std::string_view>() : model.language->operand_cells();
  const auto any = [&](auto fills) { return std::any_of(rows.begin(), rows.end(), fills); };
  const bool has_opcodes = any([](const InstructionRow& row) { return row.opcode.has_value(); });
  const bool has_areas = any([](const InstructionRow& row) { return !row.areas.empty(); });
  const bool has_sizes = any([](const InstructionRow& row) { return row.size != 0; });
  const bool has_costs = any([](const InstructionRow& row) { return !row.cost.empty(); });

  Sheet sheet;
  if (has_opcodes) sheet.columns.emplace_back("opcode");
  sheet.columns.emplace_back("mnemonic");
  for (const std::string_view cell : in_cells) sheet.columns.emplace_back(cell);
  if (in_cells.empty()) sheet.columns.emplace_back("operands");
  if (has_areas) sheet.columns.emplace_back("areas");
  if (has_sizes) sheet.columns.emplace_back("size");
  if (has_costs) sheet.columns.emplace_back("cost");
  sheet.columns.emplace_back("meaning");
  for (const InstructionRow& row : rows) {
    auto& cells = sheet.rows.emplace_back();
    if (has_opcodes) cells.push_back(row.opcode ? opcode_text(*row.opcode) : "");
    cells.emplace_back(row.mnemonic);
    for (std::size_t i = 0; i < in_cells.size(); ++i) cells.emplace_back(row.operands[i].values);
    if (in_cells.empty()) cells.push_back(operands_text(row.operands));
    if (has_areas) cells.emplace_back(row.areas);
    if (has_sizes) cells.push_back(row.size == 0 ? "" : std::to_string(row.size));
    if (has_costs) cells.emplace_back(row.cost);
    cells.emplace_back(row.meaning);
  }
  return sheet;
}

Sheet commands(const Model& model, SheetFormat format) {
  const bool for_people = format == SheetFormat::table;
  Sheet sheet{.columns = {"command", "syntax", "meaning"}, .rows = {}};
  if (for_people) sheet.columns.insert(sheet.columns.end() - 1, "where");
  for (const CommandRow& row : model.commands) {
    sheet.rows.push_back({std::string(row.command), std::string(row.syntax), std::string(row.meaning)});
    if (for_people) sheet.rows.back().insert(sheet.rows.back().end() - 1, std::string(row.where));
  }
  return sheet;
}

/// The folder of the models' fidelity pages. The proofs of the choices are in subfolders.
constexpr std::string_view kFidelityFolder = "docs/fidelity/";

/// Returns true if one of the sections equals or contains this one: "7.4" covers "7.4" and "7.4.12".
bool covers(std::string_view sections, std::string_view section) {
  while (true) {
    const std::size_t bar = sections.find('|');
    const std::string_view one = sections.substr(0, bar);
    if (section == one || (section.starts_with(one) && section[one.size()] == '.')) return true;
    if (bar == std::string_view::npos) return false;
    sections.remove_prefix(bar + 1);
  }
}

std::string scenario_cell(const Model& model, const ChoiceRow& row, SheetFormat format) {
  std::string path = scenario_of_choice(model, row);
  if (path.empty() || format != SheetFormat::markdown) return path;
  return "[" + path.substr(path.rfind('/') + 1) + "](" + path.substr(kFidelityFolder.size()) + ")";
}

Sheet choices(const Model& model, SheetFormat format) {
  const bool for_scripts = format == SheetFormat::csv || format == SheetFormat::json;
  Sheet sheet{
      .columns = {"id", "section", "question", "chosen", "alternatives", "confidence", "why", "scenario"},
      .rows = {}};
  if (for_scripts) sheet.columns.emplace_back("section_english");
  for (const ChoiceRow& row : model.choices) {
    const std::vector<std::string_view> options = options_of(row);
    std::string alternatives;
    for (std::size_t i = 1; i < options.size(); ++i)
      alternatives += (i > 1 ? "|" : "") + std::string(options[i]);
    const std::string section =
        for_scripts ? std::string(row.section) : section_for_people(model, row.section);
    sheet.rows.push_back({std::string(row.id), section, std::string(row.question),
                          std::string(options.front()), alternatives, std::string(to_string(row.confidence)),
                          std::string(row.why), scenario_cell(model, row, format)});
    if (for_scripts) sheet.rows.back().emplace_back(section_in_english(model, row.section));
  }
  return sheet;
}

/// Returns "8E1": bits, parity, stop bits.
std::string framing_text(const pty::LineSettings& settings) {
  const char parity = settings.parity == pty::Parity::even  ? 'E'
                      : settings.parity == pty::Parity::odd ? 'O'
                                                            : 'N';
  return std::to_string(settings.data_bits) + parity + std::to_string(settings.stop_bits);
}

Sheet ports(const Model& model) {
  Sheet sheet{.columns = {"name", "kind", "bauds", "framing", "protocol"}, .rows = {}};
  for (const PortRow& row : model.line.ports) {
    std::string bauds;
    for (const int baud : row.bauds) bauds += (bauds.empty() ? "" : " ") + std::to_string(baud);
    sheet.rows.push_back({std::string(row.name), row.kind == PortRow::Kind::rs232 ? "RS232" : "RS485", bauds,
                          framing_text(row.settings), std::string(model.line.protocol.name)});
  }
  return sheet;
}

/// Lists the kinds of text blocks that a device stores. Creates a device, because only devices have this
/// list.
Sheet blocks(const Model& model) {
  Sheet sheet{.columns = {"kind", "most", "longest"}, .rows = {}};
  const std::unique_ptr<Device> device = make_device(model, DeviceSettings{});
  const PersistentMemory* const memory = std::as_const(*device).memory();
  const TextBlocks* const kept = memory == nullptr ? nullptr : memory->text_blocks();
  if (kept == nullptr) return sheet;
  for (const BlockKind& kind : kept->kinds()) {
    sheet.rows.push_back({std::string(kind.name), std::to_string(kind.max), std::to_string(kind.longest)});
  }
  return sheet;
}

}  // namespace

std::string scenario_of_choice(const Model& model, const ChoiceRow& row) {
  if (options_of(row).size() < 2) return {};
  const auto proof = std::find_if(model.proofs.begin(), model.proofs.end(), [&](const ProofRow& proved) {
    return covers(proved.sections, row.section);
  });
  if (proof == model.proofs.end()) return {};
  return std::string(kFidelityFolder) + "proofs/" + std::string(model.name) + "/" + std::string(proof->name) +
         ".yaml";
}

std::optional<Sheet> describe(const Model& model, std::string_view what, SheetFormat format) {
  if (what == "registers") return registers(model, format);
  if (what == "parameters") return parameters(model, format);
  if (what == "instructions") return instructions(model);
  if (what == "commands") return commands(model, format);
  if (what == "choices") return choices(model, format);
  if (what == "ports") return ports(model);
  if (what == "blocks") return blocks(model);
  return std::nullopt;
}

}  // namespace understudy::emulator
