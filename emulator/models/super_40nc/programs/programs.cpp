// The events for step programs, and the registers that show the programs' state.
#include "emulator/models/super_40nc/programs/programs.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/program_watch.h"
#include "base/state/state_bytes.h"
#include "emulator/models/super_40nc/programs/program_machine.h"
#include "emulator/models/super_40nc/programs/user_table.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/step_programs.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

void Programs::handle(language::Event event, language::Area area) {
  ProgramMachine machine(*this, controls_);
  language::StepPrograms(state_.steps, codes_, machine, options_).take(event, area);
}

void Programs::broken(const Broken& broken) {
  const motion::Cause why = broken.why;
  controls_.moves.break_program(broken.mover, broken.axis);
  const auto area = static_cast<language::Area>(broken.mover);
  const language::Phase phase = state_.steps.programs[language::index_of(area)].phase;
  // A motion outside the lines also resets a running program, but not a program that has ended.
  const bool runs_on = !broken.is_awaited && phase != language::Phase::idle;
  const bool is_limit = why == motion::Cause::limit_plus || why == motion::Cause::limit_minus;
  const bool is_soft = why == motion::Cause::soft_limit_plus || why == motion::Cause::soft_limit_minus;
  const bool pauses =
      (is_limit && chose(option("el_resets", "pauses_at_the_line"))) ||
      (is_soft && chose(option("soft_limit_resets", "pauses_at_the_line"))) ||
      (why == motion::Cause::alarm && chose(option("alm_resets", "pauses_at_the_line"))) ||
      (why == motion::Cause::comparator && chose(option("comparator_resets", "pauses_at_the_line")));
  if (pauses && !runs_on) return handle(language::Event::limit_pauses, area);
  if (pauses) return;
  handle(runs_on ? language::Event::stop : language::Event::broken, area);
}

void Programs::path_broken(motion::Cause why) {
  const language::Phase phase = state_.steps.programs[0].phase;
  // A program that is joining paths is not waiting for this one.
  const bool is_awaited = phase == language::Phase::moving || phase == language::Phase::held;
  broken({.is_awaited = is_awaited, .why = why});
}

void Programs::notify_watch() const {
  if (watch() == nullptr) return;
  std::uint64_t mark = hash_of({});
  for (const auto& [name, text] : ready_texts_) {
    mark = hash_of(std::as_bytes(std::span(name)), mark ^ text.digest());
  }
  watch()->program_loaded(mark);
}

namespace {

/// Hides C from an observer while C runs a user table, which nobody has downloaded.
class WithoutC final : public ProgramWatch {
 public:
  explicit WithoutC(ProgramWatch& watch) : watch_(watch) {}
  void program_loaded(std::uint64_t mark) override { watch_.program_loaded(mark); }
  void runs(int part, int line, std::int64_t times) override {
    if (part != 0) watch_.runs(part, line, times);
  }
  void decides(int part, int line, bool outcome, std::int64_t times) override {
    if (part != 0) watch_.decides(part, line, outcome, times);
  }

 private:
  ProgramWatch& watch_;
};

}  // namespace

void Programs::run_steps() {
  if (!are_busy()) return;
  ProgramMachine machine(*this, controls_);
  notify_watch();
  std::optional<WithoutC> without_c;
  if (watch() != nullptr && state_.table.runs != UserTable::Runs::nothing) {
    machine.set_watch(&without_c.emplace(*watch()));
  }
  language::StepPrograms(state_.steps, codes_, machine, options_).run_slices();
  state_.plc_quiet_scans = 0;  // the step programs may have written values that the PLC reads
}

bool Programs::are_busy() const {
  return std::any_of(language::kAreas.begin(), language::kAreas.end(), [&](const language::AreaRow& row) {
    if (row.area == language::Area::plc) return false;
    const language::Phase phase = state_.steps.programs[language::index_of(row.area)].phase;
    const bool rests =
        phase == language::Phase::idle || phase == language::Phase::paused || phase == language::Phase::held;
    return !rests || ground_.contact(row.run_contact);
  });
}

bool Programs::is_pausing() const {
  const auto pauses = [](const language::StepState& program) {
    const bool rests = program.phase == language::Phase::paused || program.phase == language::Phase::held;
    return rests && program.is_paused_by_key;
  };
  const auto& all = state_.steps.programs;
  const bool rests = all[0].phase == language::Phase::paused || all[0].phase == language::Phase::held;
  if (rests && chose(option("m8022_scope", "c_also_by_m8000"))) return true;
  if (!chose(option("m8022_scope", "every_program"))) return pauses(all[0]);
  return std::any_of(all.begin(), all.end(), pauses);
}

int Programs::shown_base(std::size_t program) const {
  const bool is_absolute = chose(option("step_numbers_relative", "absolute"));
  return is_absolute ? language::base_of(static_cast<language::Area>(program), options_) : 0;
}

std::int32_t Programs::shown_step(std::size_t program) const {
  const language::StepState& steps = state_.steps.programs[program];
  const bool moves = steps.phase == language::Phase::moving || steps.phase == language::Phase::homing;
  const bool shows_next = moves && chose(option("step_shown", "the_next_ones"));
  return shown_base(program) + (shows_next ? steps.next_step : steps.step);
}

void Programs::set_pointer(int program, std::int32_t step) {
  ProgramMachine machine(*this, controls_);
  language::StepPrograms(state_.steps, codes_, machine, options_)
      .set_step(static_cast<language::Area>(program), step);
}

}  // namespace understudy::emulator::models::super_40nc
