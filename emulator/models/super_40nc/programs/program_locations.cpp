// The current locations of the programs, for observers.
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/lines.h"
#include "emulator/device/user_program.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/programs/programs.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/step_code.h"
#include "interpreter/super_40nc/step_programs.h"

namespace understudy::emulator::models::super_40nc {

namespace {

namespace language = interpreter::super_40nc;

/// Returns the first line of a listing that begins in this way, after the head of an area, or 0 if there is
/// none.
int line_of_step(std::string_view text, std::string_view area, const std::string& begin) {
  const std::string head = "AREA " + std::string(area);
  bool is_inside = false;
  for (const TextLine line : TextLines(text)) {
    if (line.text.starts_with("AREA ") || line.text.starts_with("FILE ")) {
      is_inside = line.text == head || line.text.starts_with(head + " ");
    } else if (is_inside && line.text == begin) {
      return line.number;
    }
  }
  return 0;
}

/// Returns why a program has stopped, if D8094 shows it.
std::string why_of(const ErrorReport& error, language::Area area, bool is_idle) {
  const bool stops_all = error.code == Code::emergency_stop || error.code == Code::emergency_input;
  if (error.code == Code::none || (error.area != area && !(stops_all && is_idle))) return {};
  const std::string step = error.area == area ? " at step " + std::to_string(error.step) : "";
  return "D8094 = " + std::to_string(static_cast<int>(error.code)) + step + ": " +
         std::string(language::words_of(error.code));
}

}  // namespace

std::vector<ProgramLocation> Programs::program_locations() const {
  std::vector<ProgramLocation> all;
  const std::string text = stored_.program_text();
  for (int i = 0; i < language::kStepProgramCount; ++i) {
    const language::AreaRow& row = language::kAreas[static_cast<std::size_t>(i)];
    const language::StepState& step = state_.steps.programs[static_cast<std::size_t>(i)];
    const language::StepCode& code = codes_[static_cast<std::size_t>(i)];
    if (code.is_empty()) continue;
    ProgramLocation place;
    place.program = row.name;
    const bool is_idle = step.phase == language::Phase::idle;
    place.why = why_of(ground_.state().error, row.area, is_idle);
    const bool is_of_error = is_idle && ground_.state().error.area == row.area;
    if (is_of_error && !place.why.empty() && !language::leaves_program_running(ground_.state().error.code)) {
      place.state = ProgramLocation::State::failed;
    }
    // The line is the current one, or the line that stopped the program.
    const int at =
        is_of_error ? ground_.state().error.step - language::base_of(row.area, options_) : step.step;
    const auto listed = [&](int number) {
      const int line = code.line_at(number);
      if (line < 0) return std::pair(0, std::string());
      const std::string code_text = language::text_of(code.line(line));
      for (const int base : {row.base, row.older_base, 0}) {
        const int found = line_of_step(text, row.name, std::to_string(base + number) + " " + code_text);
        if (found != 0) return std::pair(found, code_text);
      }
      return std::pair(0, code_text);
    };
    if (!is_idle || (is_of_error && !place.why.empty())) std::tie(place.line, place.text) = listed(at);
    for (auto call = step.calls.rbegin(); call != step.calls.rend(); ++call) {
      place.callers.push_back(listed(call->back).first);
    }
    switch (step.phase) {
      case language::Phase::idle: break;
      case language::Phase::executing: place.state = ProgramLocation::State::running; break;
      case language::Phase::moving: place.waits_for = "its motion to end"; break;
      case language::Phase::homing: place.waits_for = "its axes to be home"; break;
      case language::Phase::waiting: place.waits_for = place.text; break;
      case language::Phase::paused: place.waits_for = "its start (paused)"; break;
      case language::Phase::held: place.waits_for = "its start (held)"; break;
    }
    if (!place.waits_for.empty()) place.state = ProgramLocation::State::waiting;
    const bool is_timed = step.phase == language::Phase::waiting && step.left_ms > 0;
    if (is_timed) place.until = time_of(now() + step.left_ms);
    all.push_back(std::move(place));
  }
  if (!ladder_->is_empty()) all.push_back(plc_location());
  return all;
}

/// Returns the location of the PLC. It has no current line, because each scan runs all lines.
ProgramLocation Programs::plc_location() const {
  ProgramLocation place;
  place.program = language::row_of(language::Area::plc).name;
  place.why = why_of(ground_.state().error, language::Area::plc, !state_.plc.runs);
  if (state_.plc.runs) {
    place.state = ProgramLocation::State::running;
  } else if (!place.why.empty()) {
    place.state = ProgramLocation::State::failed;
  }
  return place;
}

}  // namespace understudy::emulator::models::super_40nc
