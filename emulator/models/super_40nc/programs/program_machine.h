// A SUPER-40NC as its programs see it: contacts and registers as a host would write them, and motions as
// values.
#pragma once

#include <functional>

#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/programs/programs.h"
#include "interpreter/super_40nc/machine.h"
#include "motion/path.h"

namespace understudy::emulator::models::super_40nc {

namespace language = interpreter::super_40nc;

/// Returns true if the line sets the field of this axis.
inline bool is_set(const language::AxisValues& values, int axis) {
  return values[static_cast<std::size_t>(axis)].has_value();
}
inline std::int32_t value_of_axis(const language::AxisValues& values, int axis) {
  return values[static_cast<std::size_t>(axis)].value_or(0);
}

class ProgramMachine final : public language::Machine, protected Chips {
 public:
  ProgramMachine(Programs& programs, const Controls& controls)
      : Chips(controls.parts.chips), programs_(programs), controls_(controls) {
    set_watch(programs.watch());
  }

  language::CellLayout layout() const override;
  std::span<std::uint32_t> cells() override { return ground_.state().image; }
  void retentive_cell_written(std::uint32_t cell) override;
  bool special_contact(int number) const override;
  bool set_special_contact(int number, bool on) override;
  std::int32_t special_register(int number) const override;
  bool set_special_register(int number, std::int32_t value) override;
  std::int32_t parameter_in_force(int number) const override;
  std::int32_t rpm_at_power_up(int axis) const override;
  void report(language::Code code, language::Area area, int step) override;

  bool is_held_in_reset(language::Area area) const override;
  void program_starts(language::Area area) override;
  void program_ended(language::Area area) override;
  language::Begun begin(language::Area by, const language::LinearMove& move) override;
  language::Begun begin(language::Area by, const language::CentreArc& arc) override;
  language::Begun begin(language::Area by, const language::PointArc& arc) override;
  language::Begun begin(language::Area by, const language::RadiusArc& arc) override;
  language::Begun begin(language::Area by, const language::Drive& drive) override;
  language::Begun begin(language::Area by, const language::MarkSearch& search) override;
  language::Begun begin(language::Area by, const language::HomeSearch& search) override;
  language::Begun begin(language::Area by, const language::Rotation& rotation) override;
  language::Begun begin(language::Area by, const language::WheelRatios& ratios) override;
  bool is_running(language::Area by) const override;
  void hold(language::Area by) override;
  void resume_motions(language::Area by) override;
  void drop_held(language::Area by) override;
  language::Areas stop(language::Area area) override;
  void waits_no_more(language::Area by) override;

  void plc_drive(const language::Drive& drive, int step) override;
  void plc_home(const language::HomeSearch& search, int step) override;
  bool plc_jog(const language::Jogs& jogs, const language::JogSteps& steps) override;
  bool set_positions(const language::SetPositions& positions) override;

 private:
  AxisState& state_of(int axis) { return Chips::axis(axis); }
  const AxisState& state_of(int axis) const { return Chips::axis(axis); }
  bool plc_takes_none(language::AxisSet axes, Request request);
  /// Begins a motion on each free axis of a line, and reports the others. Begins none if one of them must
  /// wait.
  template <class Start>
  language::Begun begin_each(language::Area by, const language::AxisValues& values, Request request,
                             Start start);

  struct ArcFrame;
  using Geometry = std::function<motion::Path(const motion::Point&, const motion::Point&)>;
  language::Begun begin_on_path(const std::array<bool, kAxisCount>& takes,
                                const std::array<std::int64_t, kAxisCount>& target_lu, std::int32_t feed,
                                int mode, const Geometry& geometry);
  /// Skips an impossible arc. With `reports`, also reports it or (depending on a choice) begins a line
  /// instead.
  language::Begun begin_arc(const ArcFrame& frame, std::int32_t feed, int mode, bool reports,
                            const Geometry& geometry);
  ArcFrame frame_of(language::Plane plane, language::Targets targets, const language::PlanePoint& end) const;
  std::int64_t target_of(const ArcFrame& frame, std::size_t i, language::Targets targets,
                         const std::optional<std::int32_t>& value) const;
  double radius_for(std::int32_t radius_lu, const motion::Point& from, const motion::Point& to) const;
  motion::Turn turn_of(language::Turn turn, language::Plane plane) const;

  Programs& programs_;
  const Controls& controls_;
};

}  // namespace understudy::emulator::models::super_40nc
