#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/model_option.h"
#include "emulator/command_line/program_texts.h"
#include "emulator/command_line/text_argument.h"
#include "emulator/device/firmware_message.h"
#include "emulator/device/model.h"
#include "emulator/device/more_mistakes.h"
#include "emulator/device/program_cells.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"

// Converts programs between text and numbers. All models with a language support text, and some also support
// numbers.
namespace understudy::emulator::command_line {

namespace {

/// The input of a conversion in either direction.
struct ProgramFile {
  const ProgramCells& cells;
  DeviceSettings settings;
  std::string text;
};

/// Reads the program. On failure, prints one line to standard error and returns nothing.
std::optional<ProgramFile> open_program(ModelList models, const ProgramTextArguments& arguments,
                                        const char* command) {
  const Model& model = require_model(models, arguments.model);
  const ProgramLanguage& language = require_language(model);
  if (language.cells() == nullptr) {
    throw UsageError(std::string(command) + ": a " + std::string(language.name()) +
                     " is not sent as numbers; expected another --model, or `check --model " +
                     std::string(model.name) + "`");
  }
  DeviceSettings settings = program_settings(model, arguments);
  auto text = read_text_argument(arguments.file);
  if (!text) {
    std::fprintf(stderr, "%s: %s; expected a file\n", arguments.file.c_str(), text.why.c_str());
    return std::nullopt;
  }
  if (const std::string why = is_another_kind(*text, ContentKind::program); !why.empty()) {
    std::fprintf(stderr, "%s:1: %s\n", arguments.file.c_str(), why.c_str());
    return std::nullopt;
  }
  return ProgramFile{.cells = *language.cells(), .settings = std::move(settings), .text = *text};
}

}  // namespace

int assemble_program(ModelList models, const ProgramTextArguments& arguments) {
  const auto program = open_program(models, arguments, "asm");
  if (!program) return kExitBadInput;
  try {
    std::fputs(to_text(program->cells.assemble(program->text, program->settings)).c_str(), stdout);
  } catch (const ProgramError& error) {
    print_mistakes(error.mistakes, arguments.file);
    return kExitBadInput;
  }
  return kExitWell;
}

int disassemble_program(ModelList models, const ProgramTextArguments& arguments) {
  const auto program = open_program(models, arguments, "disasm");
  if (!program) return kExitBadInput;
  try {
    const std::vector<CellRow> rows = read_cells(program->text, program->cells.cell_form());
    std::fputs(program->cells.disassemble(rows, program->settings).c_str(), stdout);
  } catch (const ProgramError& error) {
    print_mistakes(error.mistakes, arguments.file);
    return kExitBadInput;
  }
  return kExitWell;
}

const ProgramLanguage& require_language(const Model& model) {
  if (model.language == nullptr) throw UsageError(no_program(model).what);
  return *model.language;
}

DeviceSettings program_settings(const Model& model, const ProgramTextArguments& arguments) {
  DeviceSettings settings;
  if (!arguments.firmware.empty()) {
    settings.firmware = parse_firmware(arguments.firmware);
    if (settings.firmware == 0) throw UsageError("--firmware: " + why_no_firmware(model, arguments.firmware));
  }
  for (const std::string& choice : arguments.choices) {
    const std::size_t equals = choice.find('=');
    if (equals == std::string::npos)
      throw UsageError("--choice: " + quoted(choice) + " is not understood; expected ID=OPTION");
    settings.choices[choice.substr(0, equals)] = choice.substr(equals + 1);
  }
  return checked_settings(model, settings);
}

void print_mistakes(const std::vector<ProgramMistake>& mistakes, const std::string& file) {
  for (const ProgramMistake& mistake : with_word_of_more(mistakes)) {
    std::fprintf(stderr, "%s\n", one_line(in_file(mistake, file)).c_str());
  }
}

}  // namespace understudy::emulator::command_line
