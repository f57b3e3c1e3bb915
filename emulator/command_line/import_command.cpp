// Implements `import`: creates a model file from a list of registers.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/command_line/box_bench.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/new_files.h"
#include "emulator/command_line/text_argument.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_fields.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_text.h"
#include "emulator/model_file/register_list.h"
#include "emulator/model_file/starter.h"
#include "emulator/model_file/thing_reader.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;

bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }

/// Returns the file's name without its extension, reduced to the characters that are allowed in a model's
/// name.
std::string name_of_list(const std::string& path) {
  fs::path stem = fs::path(path).stem();
  if (stem.extension() == ".tm" || stem.extension() == ".td") stem = stem.stem();  // of Things
  std::string name;
  for (const char c : stem.string()) name += is_of_name(c) ? c : '-';
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

/// Returns the settings in the flags for reading the list.
model_file::ListReading reading_of(const ImportArguments& arguments) {
  model_file::ListReading reading{.guesses_addresses = true, .encoding = arguments.encoding};
  const auto index_in = [](const auto& words, const std::string& flag, const std::string& word) {
    const auto found = std::find(words.begin(), words.end(), word);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    std::string known;
    for (const std::string_view one : words) known += (known.empty() ? "" : ", ") + std::string(one);
    throw UsageError(flag + ": " + quoted(word) + " is not valid; expected one of " + known);
  };
  if (!arguments.columns.empty()) {
    try {
      model_file::parse_columns(arguments.columns, reading);
    } catch (const std::invalid_argument& error) {
      throw UsageError(std::string("--columns: ") + error.what());
    }
  }
  if (!arguments.addresses.empty()) {
    reading.addresses = static_cast<model_file::AddressReading>(
        index_in(model_file::kAddressReadings, "--addresses", arguments.addresses));
  }
  constexpr std::array kTables{Table::holding, Table::input, Table::coil, Table::discrete};
  std::array<std::string_view, kTables.size()> tables;
  std::transform(kTables.begin(), kTables.end(), tables.begin(), [](Table one) { return to_string(one); });
  if (!arguments.table.empty()) reading.table = kTables.at(index_in(tables, "--table", arguments.table));
  if (!reading.encoding.empty()) index_in(model_file::kEncodings, "--encoding", reading.encoding);
  return reading;
}

/// Reads the list. Throws FileError; for a capture, the error suggests the right command. A row of a list can
/// look like a row of a capture, so only text that is not a list is checked for this.
model_file::RegisterList read_list(const std::string& text, const std::string& path,
                                   const model_file::ListReading& reading) {
  try {
    return model_file::read_list_file(text, path, reading);
  } catch (const FileError& error) {
    const std::string_view what = error.what();
    const bool has_headings =
        what.find(": columns: ") == what.npos && what.find(": registers: ") == what.npos;
    const std::string why = why_no_capture_is_expected(text, ContentKind::registers);
    if (has_headings || why.empty()) throw;
    throw FileError({path, 1, 1}, "registers: " + why);
  }
}

/// Returns the address settings in the flags for a Thing, which has no other settings.
std::optional<model_file::AddressReading> require_thing_flags(const ImportArguments& arguments,
                                                              const model_file::ListReading& reading) {
  const std::array<std::pair<const char*, const std::string*>, 3> others{
      {{"--columns", &arguments.columns},
       {"--table", &arguments.table},
       {"--encoding", &arguments.encoding}}};
  for (const auto& [flag, value] : others) {
    if (!value->empty())
      throw UsageError(std::string(flag) + ": does not apply to a Thing Model; expected a CSV list");
  }
  if (reading.addresses == model_file::AddressReading::modicon)
    throw UsageError("--addresses: a Thing Model has no Modicon numbers; expected wire or from_one");
  return reading.addresses;
}

}  // namespace

int import_registers(ModelList models, const ImportArguments& arguments) {
  const std::string name = require_name(models, arguments);
  const model_file::ListReading reading = reading_of(arguments);
  if (!arguments.output.empty() && !names_model_file(arguments.output))
    throw UsageError("--output: " + quoted(arguments.output) +
                     " does not end in .yaml; expected a model file");
  const auto text = read_text_argument(arguments.list);
  if (!text)
    throw FileError(arguments.list + ": registers: " + text.why + "; expected a list of registers (CSV)");
  std::optional<model_file::ThingList> thing;
  if (const auto thing_text = model_file::text_of_thing(*text))
    thing = model_file::read_thing(*thing_text, arguments.list, require_thing_flags(arguments, reading));
  const model_file::RegisterList read = thing ? thing->list : read_list(*text, arguments.list, reading);
  for (const FileError::Diagnostic& remark : read.remarks.all())
    std::fprintf(stderr, "%s\n", remark.text.c_str());
  const fs::path folder = fs::path(arguments.list).parent_path();
  const fs::path output = arguments.output.empty() ? folder / (name + ".yaml") : fs::path(arguments.output);
  const fs::path list = thing ? fs::path(output).replace_extension(".csv") : fs::path(arguments.list);
  const fs::path bench = output.parent_path() / (output.stem().string() + "-bench.yaml");
  const fs::path from = output.has_parent_path() ? output.parent_path() : fs::path(".");
  const std::string list_from_there = fs::proximate(list, from).string();
  std::vector<NewFile> files;
  if (thing) files.push_back({list.string(), thing->csv});
  const int station = thing ? thing->unit.value_or(1) : 1;
  const model_file::ListReading read_so = thing ? model_file::ListReading() : reading;
  files.push_back({output.string(), model_file::starter_model(read, read_so, name, list_from_there)});
  files.push_back({bench.string(), model_file::starter_bench(name, output.filename().string(), station)});
  require_new(files);
  write_all(files);
  std::printf("%s: %s\n", arguments.list.c_str(), counts_text(read.registers).c_str());
  for (const NewFile& file : files) std::printf("wrote %s\n", file.path.c_str());
  const std::string port = (bench.parent_path() / (name + ".port")).string();
  std::printf("next: understudy serve %s\n", bench.string().c_str());
  std::printf("      understudy poll %s --model %s '%s'\n", port.c_str(), output.string().c_str(),
              read.registers.front().name.c_str());
  std::printf("      then bind the axes to their registers in %s: docs/import.md\n", output.string().c_str());
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
