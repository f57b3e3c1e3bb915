#include "emulator/device/describe/describe.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace understudy::emulator {

namespace {

std::string hex4(unsigned number) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "0x%04X", number);
  return text.data();
}

std::string hex2(unsigned number) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "0x%02X", number);
  return text.data();
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

/// What is English in the manual already stays as it is.
std::string_view section_in_english(const Model& model, std::string_view section) {
  for (const SectionRow& row : model.sections) {
    if (row.name == section) return row.in_english;
  }
  return section;
}

/// "狀態相關 (status)"
std::string section_for_people(const Model& model, std::string_view section) {
  const std::string_view english = section_in_english(model, section);
  return std::string(section) + (english == section ? "" : " (" + std::string(english) + ")");
}

std::string width_of(const RegisterRow& row) { return std::to_string(emulator::width_of(row.type)); }

/// "0 READY, 4-7 STATE"
std::string fields_of(const RegisterRow& row) {
  std::string text;
  for (const BitField& field : row.fields) {
    text += (text.empty() ? "" : ", ") + std::to_string(field.bit);
    if (field.width > 1) text += "-" + std::to_string(field.bit + field.width - 1);
    text += " " + std::string(field.name);
  }
  return text;
}

std::string kept_text(const RegisterRow& row, bool for_people) {
  if (row.needs_no_time && for_people) return "at once";
  return row.persistent ? "1" : "0";
}

template <typename Holds>
bool any_row(const Model& model, Holds holds) {
  const auto rows = register_rows(model);
  return std::any_of(rows.begin(), rows.end(), holds);
}

Sheet registers(const Model& model, SheetFormat format) {
  const bool for_people = format == SheetFormat::table;
  Sheet sheet{.columns = {"table", "address", "name", "access", "width", "signed", "min", "max", "unit",
                          "persistent", "default"},
              .rows = {}};
  if (for_people) {
    for (const char* column : {"since", "section", "not modelled"}) sheet.columns.emplace_back(column);
  }
  // Columns that only some models need.
  const bool has_reals = any_row(model, [](const RegisterRow& row) { return row.type == Type::f32; });
  const bool has_fields = any_row(model, [](const RegisterRow& row) { return !row.fields.empty(); });
  if (has_reals) sheet.columns.emplace_back("real");
  if (has_fields) sheet.columns.emplace_back("bits");
  for (const RegisterRow& row : register_rows(model)) {
    for (int index = 0; index < row.count; ++index) {
      sheet.rows.push_back(
          {std::string(to_string(row.table)), hex4(address_of(row, index)), RegisterMap::name_of(row, index),
           std::string(to_string(row.access)), width_of(row), is_signed(row.type) ? "1" : "0",
           row.ranged ? value_text(row.min, row.type) : "", row.ranged ? value_text(row.max, row.type) : "",
           std::string(row.unit), kept_text(row, for_people), value_text(row.factory, row.type)});
      auto& cells = sheet.rows.back();
      if (for_people) {
        cells.push_back(row.since == 0 ? "" : version_text(row.since));
        cells.push_back(section_for_people(model, row.section));
        cells.emplace_back(row.unmodelled);
      }
      if (has_reals) cells.emplace_back(row.type == Type::f32 ? "1" : "0");
      if (has_fields) cells.push_back(fields_of(row));
    }
  }
  return sheet;
}

/// Those that are registers have a row in the table of registers, with the rest.
Sheet parameters(const Model& model) {
  const bool has_named = !model.named_parameters.empty();
  Sheet sheet{.columns = {"number", "name", "address", "width", "persistent"}, .rows = {}};
  if (has_named) {
    for (const char* column : {"min", "max", "unit", "default", "meaning", "not modelled"}) {
      sheet.columns.emplace_back(column);
    }
  }
  for (const NamedParameterRow& row : model.named_parameters) {
    sheet.rows.push_back({std::string(row.number), std::string(row.name), "", std::to_string(row.width),
                          row.persistent ? "1" : "0"});
    for (const std::string_view cell : {std::string_view(row.least), std::string_view(row.most), row.unit,
                                        std::string_view(row.factory), row.meaning, row.unmodelled}) {
      sheet.rows.back().emplace_back(cell);
    }
  }
  for (const ParameterRow& parameter : model.parameters) {
    for (const RegisterRow& row : register_rows(model)) {
      if (row.name != parameter.register_name) continue;
      for (int i = 0; i < parameter.count; ++i) {
        sheet.rows.push_back({std::to_string(parameter.first + i), RegisterMap::name_of(row, i),
                              hex4(address_of(row, i)), width_of(row), row.persistent ? "1" : "0"});
        sheet.rows.back().resize(sheet.columns.size());
      }
    }
  }
  return sheet;
}

Sheet instructions(const Model& model) {
  Sheet sheet{.columns = {"opcode", "mnemonic", "data1", "data2", "meaning"}, .rows = {}};
  for (const InstructionRow& row : model.instructions) {
    sheet.rows.push_back({hex2(static_cast<unsigned>(row.opcode)), std::string(row.mnemonic),
                          std::string(row.data1), std::string(row.data2), std::string(row.meaning)});
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

std::string scenario_cell(const Model& model, const ChoiceRow& row, SheetFormat format) {
  std::string path = scenario_of_choice(model, row);
  if (path.empty() || format != SheetFormat::markdown) return path;
  return "[" + std::string(row.id) + ".yaml](../../" + path + ")";  // from docs/fidelity/
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

}  // namespace

std::string scenario_of_choice(const Model& model, const ChoiceRow& row) {
  if (options_of(row).size() < 2) return {};
  return "scenarios/choices/" + std::string(model.name) + "/" + std::string(row.id) + ".yaml";
}

std::optional<Sheet> describe(const Model& model, std::string_view what, SheetFormat format) {
  if (what == "registers") return registers(model, format);
  if (what == "parameters") return parameters(model);
  if (what == "instructions") return instructions(model);
  if (what == "commands") return commands(model, format);
  if (what == "choices") return choices(model, format);
  return std::nullopt;
}

}  // namespace understudy::emulator
