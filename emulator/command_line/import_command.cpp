// Implements `import`: makes a model file from a list of registers.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/new_files.h"
#include "emulator/command_line/text_argument.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/starter.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;

bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }

/// Returns the file's name without its ending, in the letters that a model's name may have.
std::string name_of_list(const std::string& path) {
  std::string name;
  for (const char c : fs::path(path).stem().string()) name += is_of_name(c) ? c : '-';
  return name;
}

std::string require_name(ModelList models, const ImportArguments& arguments) {
  const std::string name = arguments.name.empty() ? name_of_list(arguments.list) : arguments.name;
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_of_name))
    throw UsageError("--name: " + quoted(name) + " is not a name; expected letters, digits, _ and -");
  if (find_model(models, name) != nullptr)
    throw UsageError("--name: " + quoted(name) + " is the name of an existing model; expected another name");
  return name;
}

/// Returns a summary such as "23 registers (20 holding, 3 input)".
std::string counts_text(const std::vector<models::imported::ListedRegister>& registers) {
  std::string parts;
  for (const Table table : {Table::holding, Table::input, Table::coil, Table::discrete}) {
    const auto count = std::count_if(registers.begin(), registers.end(),
                                     [&](const auto& listed) { return listed.table == table; });
    if (count == 0) continue;
    parts += (parts.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(to_string(table));
  }
  return std::to_string(registers.size()) + (registers.size() == 1 ? " register (" : " registers (") + parts +
         ")";
}

/// Returns a remark if all addresses may be Modicon numbers. These count from 1, with a digit for the table
/// in front: 40001 is the first holding register. A list may mean them, or addresses as on the wire, so
/// import takes the numbers as printed and adds the remark.
std::string remark_on_addresses(const std::vector<models::imported::ListedRegister>& registers) {
  struct Block {
    Table table;
    int first;
  };
  constexpr std::array kBlocks{Block{Table::holding, 40001}, Block{Table::input, 30001},
                               Block{Table::discrete, 10001}};
  constexpr int kSize = 9999;
  bool begins_with_digit = false;
  for (const auto& listed : registers) {
    const auto* const block = std::find_if(kBlocks.begin(), kBlocks.end(),
                                           [&](const Block& row) { return row.table == listed.table; });
    if (block == kBlocks.end()) continue;  // Modicon numbers of coils have no digit
    if (listed.address < block->first || listed.address >= block->first + kSize) return "";
    begins_with_digit = true;
  }
  if (!begins_with_digit) return "";
  return "note: these addresses look like Modicon addresses (40001 for holding register 0); they are used on "
         "the wire unchanged (docs/import.md)";
}

}  // namespace

int import_registers(ModelList models, const ImportArguments& arguments) {
  const std::string name = require_name(models, arguments);
  if (!arguments.output.empty() && !names_model_file(arguments.output))
    throw UsageError("--output: " + quoted(arguments.output) +
                     " does not end in .yaml; expected a model file");
  const auto text = read_text_argument(arguments.list);
  if (!text)
    throw FileError(arguments.list + ": registers: " + text.why + "; expected a list of registers (CSV)");
  if (const std::string why = is_another_kind(*text, ContentKind::registers); !why.empty()) {
    throw FileError({arguments.list, 1, 1}, "registers: " + why);
  }
  const auto registers = model_file::read_list_file(*text, arguments.list);
  const fs::path list(arguments.list);
  const fs::path output =
      arguments.output.empty() ? list.parent_path() / (name + ".yaml") : fs::path(arguments.output);
  const fs::path bench = output.parent_path() / (output.stem().string() + "-bench.yaml");
  const fs::path from = output.has_parent_path() ? output.parent_path() : fs::path(".");
  const std::string list_from_there = fs::proximate(list, from).string();
  const std::vector<NewFile> files{
      {output.string(), model_file::starter_model(registers, name, list_from_there)},
      {bench.string(), model_file::starter_bench(name, output.filename().string())}};
  require_new(files);
  write_all(files);
  std::printf("%s: %s\n", arguments.list.c_str(), counts_text(registers).c_str());
  for (const NewFile& file : files) std::printf("wrote %s\n", file.path.c_str());
  if (const std::string remark = remark_on_addresses(registers); !remark.empty())
    std::printf("%s\n", remark.c_str());
  const std::string port = (bench.parent_path() / (name + ".port")).string();
  std::printf("next: understudy serve %s\n", bench.string().c_str());
  std::printf("      understudy poll %s --model %s '%s'\n", port.c_str(), output.string().c_str(),
              registers.front().name.c_str());
  std::printf("      then bind the axes to their registers in %s: docs/import.md\n", output.string().c_str());
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
