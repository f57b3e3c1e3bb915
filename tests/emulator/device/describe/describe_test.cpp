// The output of `describe`, compared with the manual's facts. Scripts rely on the columns.
#include "emulator/device/describe/describe.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/emulator/device/register_map/register_facts.h"

namespace understudy::emulator {
namespace describe_test {

const Model& simple2() { return *find_model(models::all_models(), "simple2-r3"); }

std::string described(std::string_view what, SheetFormat format, const Model& model = simple2()) {
  const auto sheet = describe(model, what, format);
  EXPECT_TRUE(sheet) << what;
  return sheet ? format_sheet(*sheet, format) : "";
}

/// A table of `describe` as a script reads it: the header, and rows by column.
struct Csv {
  explicit Csv(std::string_view what, const Model& model = simple2()) {
    std::istringstream text(described(what, SheetFormat::csv, model));
    std::getline(text, header);
    const auto columns = csv_cells(header);
    for (std::string line; std::getline(text, line);) {
      const auto cells = csv_cells(line);
      EXPECT_EQ(cells.size(), columns.size()) << line;
      Fact& row = rows.emplace_back();
      for (std::size_t i = 0; i < columns.size(); ++i) row[columns[i]] = cells[i];
    }
  }
  std::string header;
  std::vector<Fact> rows;
};

TEST(Describe, TheColumnsOfCsvAreThoseThatScriptsRelyOn) {
  EXPECT_EQ(Csv("registers").header,
            "table,address,name,access,width,signed,min,max,unit,persistent,default");
  EXPECT_EQ(Csv("parameters").header, "number,name,address,width,persistent");
  EXPECT_EQ(Csv("instructions").header, "opcode,mnemonic,data1,data2,meaning");
  EXPECT_EQ(Csv("commands").header, "command,syntax,meaning");
  EXPECT_EQ(Csv("choices").header,
            "id,section,question,chosen,alternatives,confidence,why,scenario,section_english");
}

TEST(Describe, OtherWordsAreNotDescribed) {
  for (const char* what : {"", "register", "Registers", "coils"}) {
    EXPECT_FALSE(describe(simple2(), what, SheetFormat::csv)) << what;
  }
}

TEST(Describe, RegistersAreTheManualsOneRowAQuantity) {
  std::map<std::string, Fact> rows;
  for (const Fact& row : Csv("registers").rows) {
    EXPECT_TRUE(rows.emplace(row.at("address"), row).second) << row.at("address") << " appears twice";
  }
  const auto facts = simple2_r3_registers();
  std::size_t quantities = 0;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const RegisterFact& fact = facts[i];
    if (fact.half == 'H') continue;
    ++quantities;
    char address[8];
    std::snprintf(address, sizeof(address), "0x%04X", fact.address);
    ASSERT_TRUE(rows.contains(address)) << address;
    const Fact& row = rows.at(address);
    const auto number = [](const std::optional<Value>& value) { return value ? std::to_string(*value) : ""; };
    const std::string name = fact.address == 0xF02A ? fact.other_name : without_half(fact.name);
    EXPECT_EQ(row.at("table"), "holding") << address;
    EXPECT_EQ(row.at("name"), fact.is_32_bit || fact.address == 0xF02A ? name : fact.name) << address;
    EXPECT_EQ(row.at("access"), !fact.writable ? "R" : fact.readable ? "R/W" : "W") << address;
    EXPECT_EQ(row.at("width"), fact.is_32_bit ? "32" : "16") << address;
    EXPECT_EQ(row.at("signed"), fact.is_signed ? "1" : "0") << address;
    EXPECT_EQ(row.at("min"), number(fact.min)) << address;
    EXPECT_EQ(row.at("max"), number(fact.max)) << address;
    EXPECT_EQ(row.at("unit"), fact.unit) << address;
    EXPECT_EQ(row.at("persistent"), fact.persistent ? "1" : "0") << address;
    const std::uint32_t high = fact.is_32_bit ? facts[i + 1].factory_word : 0;
    EXPECT_EQ(row.at("default"), std::to_string(high << 16 | fact.factory_word)) << address;
  }
  EXPECT_EQ(rows.size(), quantities);
}

TEST(Describe, ParametersAreTheManuals) {
  std::map<std::string, Fact> rows;
  for (const Fact& row : Csv("parameters").rows) EXPECT_TRUE(rows.emplace(row.at("number"), row).second);
  const auto facts = read_facts(TEST_FACTS "/models/simple2_r3/simple2_r3_parameters.csv");
  EXPECT_EQ(rows.size(), facts.size());
  for (const Fact& fact : facts) {
    ASSERT_TRUE(rows.contains(fact.at("number"))) << fact.at("number");
    const Fact& row = rows.at(fact.at("number"));
    EXPECT_EQ(row.at("address"), fact.at("address")) << fact.at("number");
    EXPECT_EQ(row.at("width"), fact.at("width")) << fact.at("number");
    EXPECT_EQ(row.at("persistent"), fact.at("persistent")) << fact.at("number");
  }
}

TEST(Describe, InstructionsAreTheManuals) {
  const auto facts = read_facts(PROJECT_FOLDER "/tests/interpreter/simple2/instructions.csv");
  const Csv csv("instructions");
  ASSERT_EQ(csv.rows.size(), facts.size());
  for (std::size_t i = 0; i < facts.size(); ++i) {
    EXPECT_EQ(csv.rows[i].at("opcode"), facts[i].at("opcode"));
    EXPECT_EQ(csv.rows[i].at("mnemonic"), facts[i].at("mnemonic"));
  }
}

TEST(Describe, EveryInstructionHasAMeaningOfItsOwn) {
  std::set<std::string> meanings;
  for (const Fact& row : Csv("instructions").rows) {
    const std::string& meaning = row.at("meaning");
    EXPECT_GE(meaning.size(), 10U) << row.at("mnemonic");
    EXPECT_LE(meaning.size(), 160U) << row.at("mnemonic");
    EXPECT_TRUE(meanings.insert(meaning).second) << row.at("mnemonic") << ": " << meaning;
  }
  EXPECT_EQ(meanings.size(), 115U);
  // The text mentions the axis, counter or timer of the name.
  for (const Fact& row : Csv("instructions").rows) {
    const std::string name = row.at("mnemonic") + "_";
    const std::string& meaning = row.at("meaning");
    for (const char* axis : {"A", "B"}) {
      if (name.find("_" + std::string(axis) + "_") == std::string::npos) continue;
      EXPECT_NE(meaning.find("axis " + std::string(axis)), std::string::npos) << name;
    }
    for (const char* number : {"1", "2"}) {
      if (name.find("er" + std::string(number)) == std::string::npos) continue;  // Counter1, Timer2
      EXPECT_NE(meaning.find("er " + std::string(number)), std::string::npos) << name;
    }
  }
}

TEST(Describe, SectionsInAnotherLanguageAreTranslated) {
  const auto is_ascii = [](std::string_view text) {
    return std::none_of(text.begin(), text.end(), [](char c) { return (c & 0x80) != 0; });
  };
  for (const Model* const model : models::all_models()) {
    std::set<std::string_view> sections;
    for (const RegisterRow& row : register_rows(*model)) sections.insert(row.section);
    for (const ChoiceRow& row : model->choices) sections.insert(row.section);
    const auto named = sections;
    std::erase_if(sections, is_ascii);
    std::set<std::string_view> translated;
    for (const SectionRow& row : model->sections) {
      EXPECT_TRUE(is_ascii(row.in_english) && !row.in_english.empty()) << row.name;
      EXPECT_TRUE(translated.insert(row.name).second) << row.name << " appears twice";
    }
    // Sections that the manual only numbers can have a title as well.
    for (const std::string_view section : sections) EXPECT_TRUE(translated.contains(section)) << section;
    for (const std::string_view section : translated) EXPECT_TRUE(named.contains(section)) << section;
    for (const Fact& row : Csv("choices", *model).rows) {
      EXPECT_TRUE(is_ascii(row.at("section_english"))) << row.at("id");
    }
  }
  EXPECT_EQ(Csv("choices").rows.front().at("section_english"), "RS485");
  for (const char* what : {"registers", "choices"}) {
    EXPECT_NE(described(what, SheetFormat::table).find("狀態相關 (status)"), std::string::npos) << what;
  }
  EXPECT_NE(described("choices", SheetFormat::markdown).find("| 狀態相關 (status) |"), std::string::npos);
}

TEST(Describe, AChoiceWithAlternativesNamesItsScenario) {
  for (const Model* const model : models::all_models()) {
    std::set<std::string> named;
    for (const Fact& row : Csv("choices", *model).rows) {
      const std::string path = row.at("scenario");
      EXPECT_EQ(path.empty(), row.at("alternatives").empty()) << row.at("id");
      if (!path.empty()) named.insert(path);
    }
    std::set<std::string> proofs;
    for (const ProofRow& proof : model->proofs) {
      proofs.insert("docs/fidelity/proofs/" + std::string(model->name) + "/" + std::string(proof.name) +
                    ".yaml");
    }
    EXPECT_EQ(named, proofs);
    EXPECT_EQ(proofs.size(), model->proofs.size());
  }
  // 3.15 is before 3 in its table, and 7.4 contains 7.4.12.
  const auto file_of = [](const char* id) {
    for (const Fact& row : Csv("choices", *find_model(models::all_models(), "rs-m8194h")).rows) {
      if (row.at("id") == id) return row.at("scenario");
    }
    return std::string("no such choice");
  };
  const std::string folder = "docs/fidelity/proofs/rs-m8194h/";
  EXPECT_EQ(file_of("ring_overflow"), folder + "counters_and_variables.yaml");
  EXPECT_EQ(file_of("initial_in_macros"), folder + "settings.yaml");
  EXPECT_EQ(file_of("scan_too_fast"), folder + "paths.yaml");
  EXPECT_NE(described("choices", SheetFormat::markdown)
                .find("| [program_instructions.yaml](proofs/simple2-r3/program_instructions.yaml) |"),
            std::string::npos);
}

TEST(Describe, ParametersOfATextDeviceAreThoseOfItsList) {
  // The list's numbers and second names; widths: real numbers are 32-bit floats.
  struct Named {
    const char* number;
    const char* name;
    const char* width;
  };
  constexpr Named kNamed[] = {
      {"PN10", "VM", "32"},   {"PN14", "VJ", "32"},   {"", "FU", "16"},       {"", "VA", "32"},
      {"", "LL", "32"},       {"", "EL", "32"},       {"PN37", "PN37", "16"}, {"PN44", "PN44", "32"},
      {"PN45", "PN45", "32"}, {"PN46", "PN46", "32"}, {"PN50", "PN50", "16"}, {"PR2", "TVA", "32"},
      {"PR3", "TVM", "32"},   {"PR4", "PR4", "32"},   {"PR7", "CMA", "32"},   {"", "SYN", "16"}};
  const Csv csv("parameters", *find_model(models::all_models(), "slim"));
  EXPECT_EQ(csv.header, "number,name,address,width,persistent,min,max,unit,default,meaning,not modelled");
  ASSERT_EQ(csv.rows.size(), std::size(kNamed));
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const Fact expected{{"number", kNamed[i].number},
                        {"name", kNamed[i].name},
                        {"address", ""},
                        {"width", kNamed[i].width},
                        {"persistent", "1"}};
    for (const auto& [column, cell] : expected) EXPECT_EQ(csv.rows[i].at(column), cell) << kNamed[i].name;
    EXPECT_NE(csv.rows[i].at("meaning"), "") << kNamed[i].name;
  }
  const auto json = nlohmann::json::parse(
      described("parameters", SheetFormat::json, *find_model(models::all_models(), "slim")));
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const NamedParameterRow& row = find_model(models::all_models(), "slim")->named_parameters[i];
    EXPECT_EQ(csv.rows[i].at("min"), row.min) << row.name;
    EXPECT_EQ(csv.rows[i].at("max"), row.max) << row.name;
    EXPECT_EQ(csv.rows[i].at("unit"), row.unit) << row.name;
    EXPECT_EQ(csv.rows[i].at("default"), row.factory) << row.name;
    EXPECT_EQ(json[i].at("meaning"), row.meaning) << row.name;
    EXPECT_EQ(json[i].at("unit"), row.unit) << row.name;
  }
  const std::string table =
      described("parameters", SheetFormat::table, *find_model(models::all_models(), "slim"));
  EXPECT_NE(table.find("PR7     CMA    "), std::string::npos) << table;
  EXPECT_NE(table.find("largest angle that CM 2 joins"), std::string::npos) << table;
  EXPECT_NE(table.find("no load is computed"), std::string::npos) << table;
}

TEST(Describe, TheTableForPeopleShowsWhereACommandMayBeGiven) {
  std::istringstream table(
      described("commands", SheetFormat::table, *find_model(models::all_models(), "slim")));
  std::map<std::string, std::string> where;  // by syntax
  for (std::string line; std::getline(table, line);) {
    for (const char* syntax : {" TAPZ ", " 2MA Rn,Rm ", " 4MR Rx,Ry,Rz,Rw ", " JP addr ", " PL ", " MA x "}) {
      const std::size_t at = line.find(syntax);
      if (at == std::string::npos) continue;
      const std::size_t begin = line.find_first_not_of(' ', at + std::string(syntax).size());
      where[syntax] = line.substr(begin, line.find("  ", begin) - begin);
    }
  }
  // The second list's columns; for the first list, what makes sense.
  const std::map<std::string, std::string> expected{{" TAPZ ", "program, typed, running"},
                                                    {" 2MA Rn,Rm ", "program, typed"},
                                                    {" 4MR Rx,Ry,Rz,Rw ", "program"},
                                                    {" JP addr ", "program"},
                                                    {" PL ", "typed"},
                                                    {" MA x ", "program, typed"}};
  EXPECT_EQ(where, expected);
}

TEST(Describe, EveryChoiceIsListedWithWhatWasChosen) {
  const Csv csv("choices");
  ASSERT_EQ(csv.rows.size(), simple2().choices.size());
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const ChoiceRow& choice = simple2().choices[i];
    EXPECT_EQ(csv.rows[i].at("id"), choice.id);
    const std::string& alternatives = csv.rows[i].at("alternatives");
    EXPECT_EQ(csv.rows[i].at("chosen") + (alternatives.empty() ? "" : "|") + alternatives, choice.options);
  }
}

TEST(Describe, JsonSaysTheSameAsCsv) {
  for (const char* what : {"registers", "parameters", "instructions", "choices", "commands"}) {
    const Csv csv(what);
    const auto json = nlohmann::json::parse(described(what, SheetFormat::json));
    ASSERT_EQ(json.size(), csv.rows.size()) << what;
    for (std::size_t i = 0; i < csv.rows.size(); ++i) {
      for (const auto& [column, cell] : csv.rows[i]) {
        const auto& value = json[i].at(column);
        const std::string message = value.is_null()     ? ""
                                    : value.is_string() ? value.get<std::string>()
                                                        : value.dump();
        EXPECT_EQ(message, cell) << what << " " << column;
      }
    }
  }
  const auto registers = nlohmann::json::parse(described("registers", SheetFormat::json));
  EXPECT_EQ(registers[1]["default"], 49153) << "HW_Code";
  EXPECT_TRUE(registers[0]["address"].is_string());
}

TEST(Describe, MarkdownAndTableHaveALineForEachRow) {
  for (const char* what : {"registers", "parameters", "instructions", "choices"}) {
    const auto lines = [&](SheetFormat format) {
      const std::string text = described(what, format);
      return std::count(text.begin(), text.end(), '\n');
    };
    const auto rows = static_cast<std::ptrdiff_t>(Csv(what).rows.size());
    EXPECT_EQ(lines(SheetFormat::markdown), rows + 2) << what;
    EXPECT_EQ(lines(SheetFormat::table), rows + 1) << what;
  }
}

TEST(Describe, TheTableForPeopleShowsWhatIsNotModelled) {
  const std::string table = described("registers", SheetFormat::table);
  EXPECT_NE(table.substr(0, table.find('\n')).find("not modelled"), std::string::npos);
}

}  // namespace describe_test
}  // namespace understudy::emulator
