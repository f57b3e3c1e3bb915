#include "emulator/models/rs_m8194h/programs/language.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/program_cells.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "emulator/device/program_parts.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/listing.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/text_error.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

namespace lang = interpreter::rs_m8194h;

std::string values_of(const lang::Command& command, std::size_t parameter) {
  const std::string_view meaning = command.row().parameters[parameter].values;
  std::string values = lang::expected_of(command, parameter);
  if (!meaning.empty() && values.find(meaning) == std::string::npos) values += ": " + std::string(meaning);
  return values;
}

std::string areas_of(const lang::CommandRow& row, bool is_macro_line) {
  if (!is_macro_line) return row.use.initial ? "RTC IT" : "RTC";
  return row.use.in_mp && row.use.in_isr ? "MP ISR" : row.use.in_mp ? "MP" : "ISR";
}

/// All 229 codes. Sizes are in FIFO blocks or macro lines.
class Instructions {
 public:
  Instructions() {
    for (const lang::CommandRow& row : lang::kCommands) {
      if (!row.real_time_name.empty()) add(row, lang::real_time_code(row.verb));
      if (!row.macro_name.empty()) add(row, lang::macro_code(row.verb));
    }
  }
  std::span<const InstructionRow> rows() const { return rows_; }

 private:
  void add(const lang::CommandRow& row, std::uint16_t code) {
    const lang::Command command{.code = code};
    std::vector<OperandRow>& operands = operands_.emplace_back();
    for (std::size_t i = 0; i < row.parameter_count(); ++i) {
      operands.push_back(
          {.name = row.parameters[i].name, .values = texts_.emplace_back(values_of(command, i))});
    }
    rows_.push_back({.opcode = code,
                     .mnemonic = lang::name_of(code),
                     .operands = operands,
                     .areas = texts_.emplace_back(areas_of(row, command.is_macro_line())),
                     .size = command.is_macro_line() ? row.macro_lines() : row.fifo_blocks(),
                     .meaning = row.meaning});
  }

  // The rows point into these two containers. A deque does not move its elements.
  std::deque<std::string> texts_;
  std::deque<std::vector<OperandRow>> operands_;
  std::vector<InstructionRow> rows_;
};

/// Returns the command that opens a macro. close() returns the command that closes it.
lang::Command create(const lang::MacroName& name) {
  lang::Command command{
      .code = lang::real_time_code(name.is_isr ? lang::Verb::isr_create : lang::Verb::mp_create)};
  command.values[0] = static_cast<std::uint32_t>(name.number);
  return command;
}
lang::Command close(const lang::MacroName& name) {
  return {.code = lang::macro_code(name.is_isr ? lang::Verb::isr_close : lang::Verb::mp_close)};
}

CellRow cells_of(const lang::Command& command, const lang::Options& options) {
  CellRow row;
  const auto words = lang::encode(command, lang::WordOrder::high_first, options);
  for (const std::uint16_t word : words) row.cells.push_back(word);
  return row;
}

class Listing final : public ProgramLanguage, public ProgramCells {
 public:
  std::string_view name() const override { return "RS-M8194H macros"; }
  std::string_view file_ending() const override { return ".mac"; }
  std::span<const InstructionRow> instructions() const override {
    static const Instructions instructions;
    return instructions.rows();
  }
  std::vector<ProgramMistake> check(std::string_view text, const DeviceSettings& settings) const override {
    return mistakes_of(parse(text, settings).errors);
  }
  std::vector<ProgramPart> parts(std::string_view text, const DeviceSettings& settings) const override {
    const lang::ParsedListing parsed = parse(text, settings);
    std::vector<ProgramPart> parts;
    for (std::size_t i = 0; i < parsed.listing.macros.size(); ++i) {
      const auto& [name, macro] = parsed.listing.macros[i];
      ProgramPart& part = parts.emplace_back(ProgramPart{.number = part_of(name), .name = to_string(name)});
      for (std::size_t line = 0; line < macro.lines.size(); ++line) {
        const lang::Command& command = macro.lines[line];
        part.lines.push_back({.text_line = parsed.text_lines[i][line],
                              .code = text_of(command),
                              .decides = lang::is_one_of(command.verb(), lang::kDecidingVerbs)});
      }
    }
    return parts;
  }
  std::span<const ProgramControl> controls() const override {
    using By = ProgramControl::By;
    static constexpr std::array<ProgramControl, 2> kControls{
        {{"call MP {}", By::registers, "CALL_MPn={}", 1, 157},
         {"end all macros", By::command, "RSM_MP_TERMINATE"}}};
    return kControls;
  }
  const ProgramCells* cells() const override { return this; }

  CellForm cell_form() const override {
    return {.row = "the registers from 8000 on, one message per line",
            .fewest = 1,
            .max = 20,
            .lowest = 0,
            .highest = 0xFFFF,
            .max_rows = 7000};
  }
  /// Returns the download messages. Triggers are not sent through the window.
  std::vector<CellRow> assemble(std::string_view text, const DeviceSettings& settings) const override {
    const lang::ParsedListing parsed = parse(text, settings);
    if (!parsed.errors.empty()) throw ProgramError(mistakes_of(parsed.errors));
    if (parsed.first_trigger) {
      throw ProgramError(parsed.first_trigger->line, parsed.first_trigger->column,
                         "TRIGGER is not a message to the window; expected only macros");
    }
    const lang::Options options = language_options(settings).lines;
    std::vector<CellRow> rows;
    for (const lang::ListedMacro& listed : parsed.listing.macros) {
      rows.push_back(cells_of(create(listed.name), options));
      for (const lang::Command& line : listed.macro.lines) rows.push_back(cells_of(line, options));
      rows.push_back(cells_of(close(listed.name), options));
    }
    return rows;
  }
  std::string disassemble(const std::vector<CellRow>& rows, const DeviceSettings& settings) const override {
    std::string text;
    lang::State state = lang::State::ready;
    const LanguageOptions options = language_options(settings);
    for (const CellRow& row : rows) text += line_of(row, state, options.lines);
    if (state != lang::State::ready) {
      throw ProgramError(rows.back().line, 0, "ends inside a macro; expected its CLOSE");
    }
    const lang::ParsedListing parsed = parse(text, settings);
    if (!parsed.errors.empty()) throw ProgramError(mistakes_of(parsed.errors));
    return text_of(parsed.listing);
  }

 private:
  static lang::ParsedListing parse(std::string_view text, const DeviceSettings& settings) {
    const LanguageOptions options = language_options(settings);
    return lang::parse_listing(text, options.lines);
  }

  /// Returns a message as a line of a listing.
  static std::string line_of(const CellRow& row, lang::State& state, const lang::Options& options) {
    std::vector<std::uint16_t> words;
    for (const std::int64_t cell : row.cells) words.push_back(static_cast<std::uint16_t>(cell));
    const lang::Decoded decoded = lang::decode(words, state, lang::WordOrder::high_first, options);
    const lang::Command& command = decoded.command;
    if (decoded.fault != lang::Fault::none) {
      throw ProgramError(row.line, 0, std::string(lang::row_of(decoded.fault).meaning));
    }
    const lang::Verb verb = command.verb();
    if (verb == lang::Verb::mp_close || verb == lang::Verb::isr_close) {
      state = lang::State::ready;
      return "END\n";
    }
    if (verb == lang::Verb::mp_create || verb == lang::Verb::isr_create) {
      const bool is_isr = verb == lang::Verb::isr_create;
      state = is_isr ? lang::State::isr_download : lang::State::mp_download;
      return (is_isr ? "ISR " : "MP ") + std::to_string(command.values[0]) + "\n";
    }
    if (state == lang::State::ready) {
      throw ProgramError(row.line, 0, lang::text_of(command) + " is not in a macro; expected its CREATE");
    }
    return lang::text_of(command) + "\n";
  }
};

}  // namespace

const ProgramLanguage& language() {
  static const Listing listing;
  return listing;
}

std::vector<ProgramMistake> mistakes_of(const std::vector<lang::TextError>& errors) {
  std::vector<ProgramMistake> mistakes;
  for (const lang::TextError& error : errors) mistakes.push_back({error.line, error.column, error.message});
  return mistakes;
}

}  // namespace understudy::emulator::models::rs_m8194h
