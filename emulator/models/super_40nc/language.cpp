#include "emulator/models/super_40nc/language.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "emulator/device/program_parts.h"
#include "emulator/models/super_40nc/device.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/instructions.h"
#include "interpreter/super_40nc/listing.h"

namespace understudy::emulator::models::super_40nc {

namespace {

namespace lang = interpreter::super_40nc;

/// Returns the areas in which an instruction has an effect, as in the manual's lists: "PCXYZU".
std::string areas_of(const lang::InstructionRow& row) {
  const auto acts_in = [&](lang::Area area) {
    return lang::has(row.areas, area) && !lang::has(row.void_in, area);
  };
  std::string text = acts_in(lang::Area::plc) ? "P" : "";
  for (const lang::AreaRow& area : lang::kAreas) {
    if (area.area != lang::Area::plc && acts_in(area.area)) text += area.letter;
  }
  return text;
}

std::string_view cost_of(const lang::InstructionRow& row) {
  switch (row.waits) {
    case lang::Waits::no: return "";
    case lang::Waits::for_on: return "until it is ON";
    case lang::Waits::for_off: return "until it is OFF";
    case lang::Waits::for_time: return "its time";
    case lang::Waits::for_arrival: return "until all have arrived";
    case lang::Waits::for_home: return "until all are home";
    case lang::Waits::for_standstill: return "with 0 until it is at rest";
  }
  return "";
}

/// The rows of the instructions, and the data to which they refer.
struct Instructions {
  std::array<std::array<OperandRow, 4>, lang::kInstructions.size()> operands;
  std::array<std::string, lang::kInstructions.size()> areas;
  std::array<InstructionRow, lang::kInstructions.size()> rows;

  Instructions() {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const lang::InstructionRow& row = lang::kInstructions[i];
      for (std::size_t field = 0; field < row.slots.size(); ++field) {
        const lang::Slot slot = row.slots[field];
        operands[i][field] = {
            .name = "", .values = lang::describe(slot), .may_be_unset = lang::may_be_unset(slot)};
      }
      areas[i] = areas_of(row);
      rows[i] = {.mnemonic = row.mnemonic,
                 .operands = std::span(operands[i]).first(static_cast<std::size_t>(row.fields())),
                 .areas = areas[i],
                 .size = row.steps,
                 .cost = cost_of(row),
                 .meaning = row.meaning};
    }
  }
};

class ProgramListing final : public ProgramLanguage {
 public:
  std::string_view name() const override { return "SUPER-40NC listing"; }
  std::string_view file_ending() const override { return ".lst"; }
  std::span<const InstructionRow> instructions() const override {
    static const Instructions instructions;
    return instructions.rows;
  }
  /// Checks a listing. Some rules depend on choices.
  std::vector<ProgramMistake> check(std::string_view text, const DeviceSettings& settings) const override {
    return Super40nc(settings).parts().programs.stored().mistakes_in(text);
  }
  std::vector<ProgramMistake> warnings(std::string_view text, const DeviceSettings& settings) const override {
    return Super40nc(settings).parts().programs.stored().warnings_about(text);
  }
  std::vector<ProgramPart> parts(std::string_view text, const DeviceSettings& settings) const override {
    return Super40nc(settings).parts().programs.stored().parts_of(text);
  }
  bool parts_run_at_once() const override { return true; }
  /// A key reacts when it goes ON, so these requests release it first.
  std::span<const ProgramControl> controls() const override {
    using By = ProgramControl::By;
    static constexpr std::array<ProgramControl, 11> kControls{{{"start C", By::registers, "M8000=1"},
                                                               {"pause C", By::registers, "M8597=0 M8597=1"},
                                                               {"stop C", By::registers, "M8596=0 M8596=1"},
                                                               {"start X", By::registers, "M8100=1"},
                                                               {"stop X", By::registers, "M8584=0 M8584=1"},
                                                               {"start Y", By::registers, "M8200=1"},
                                                               {"stop Y", By::registers, "M8585=0 M8585=1"},
                                                               {"start Z", By::registers, "M8300=1"},
                                                               {"stop Z", By::registers, "M8586=0 M8586=1"},
                                                               {"start U", By::registers, "M8400=1"},
                                                               {"stop U", By::registers, "M8587=0 M8587=1"}}};
    return kControls;
  }
};

}  // namespace

const ProgramLanguage& program_language() {
  static const ProgramListing listing;
  return listing;
}

}  // namespace understudy::emulator::models::super_40nc
