// Breakpoints, logpoints and steps. A debugger only observes: a run has the same states with and without
// breakpoints.
//
// Events within a tick are evaluated at its end: conditions have the values of that moment, and the world
// stops there with a complete state. Without breakpoints and steps, the debugger costs nothing. While it
// watches instructions, the world runs all ticks one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/user_program.h"
#include "emulator/world/debug/breakpoint.h"
#include "emulator/world/debug/program_lines.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

class Debugger final : private TickWatcher {
 public:
  static constexpr std::size_t kMaxBreakpoints = 256;

  /// `world` and `events` must outlive the debugger.
  Debugger(World& world, EventLog& events);
  ~Debugger() override;
  Debugger(const Debugger&) = delete;
  Debugger& operator=(const Debugger&) = delete;

  /// If this throws BreakpointError, NameError or ExpressionError, nothing has changed.
  const Breakpoint& add(const BreakpointSetup& setup);
  /// Returns false if there is no breakpoint with that number.
  bool remove(int number);
  void remove_all();
  /// Returns the breakpoints in the order of their numbers.
  /// Finds the lines again first, if a device has another program.
  std::vector<Breakpoint> breakpoints();

  /// Begins a step of the device's program. If `program` is empty, it is the part that has stopped, or any
  /// part. Throws BreakpointError.
  void begin_step(StepKind kind, std::size_t device, const std::string& program);
  void end_step();
  bool is_stepping() const { return step_ != nullptr; }
  bool is_watching() const { return is_watching_; }

  /// Returns the stop at which the world is, or null if the world has continued.
  const DebugStop* stop() const;
  /// Returns true once after each stop.
  bool take_stop();
  /// Called after the world has been put into another state.
  void restart();
  /// Until wake() is called, the debugger neither observes nor stops the world, because the world is moving
  /// to another moment.
  void sleep() { sleeps_ = true; }
  /// `stop` is the stop at which the world is now.
  void wake(std::optional<DebugStop> stop = {});

 private:
  struct Point;
  struct Step;
  class DeviceWatch;

  void on_tick(Tick tick) override;
  Tick next_poll(Tick done) const override;

  /// States of machines and programs that the event log does not contain.
  struct Sign {
    std::string_view what;  // the kind of the event: "limit"
    std::size_t device = 0;
    int axis = 0;
    Contact contact = Contact::alarm;
    bool is_on = false;
  };
  std::vector<Sign> signs_of_machines() const;
  bool shows(const Sign& sign) const;
  std::string text_of(const Sign& sign) const;
  void require_values(const Expression& expression) const;
  void parse_log(Point& point) const;
  std::string log_text(const Point& point) const;
  void locate(Point& point);
  void require_place(const Point& point) const;
  void find_write(Point& point);
  void begin_events();
  bool needs(std::size_t device) const;
  void settle();
  void check_events();
  void check_signs();
  bool waits_for_events() const;
  static bool holds(Point& point, const Probes& probes);
  std::uint64_t new_hits(Point& point);
  void judge(Point& point);
  void begin_at(Step& step, const std::string& program) const;
  std::optional<ProgramLocation> location_of(std::size_t device, const std::string& program) const;
  bool stands(std::size_t device) const;
  bool has_ended(const Step& step) const;
  void judge_step();
  void stop_with(DebugStop stop);

  World& world_;
  EventLog& events_;
  Probes probes_;
  std::vector<std::unique_ptr<Point>> points_;
  std::map<std::size_t, std::unique_ptr<DeviceWatch>> watches_;
  std::unique_ptr<Step> step_;
  std::optional<DebugStop> stop_;
  bool is_fresh_ = false;  // take_stop() has not returned the stop yet
  bool is_watching_ = false;
  bool sleeps_ = false;
  int last_number_ = 0;
  std::uint64_t next_event_ = 0;
  std::vector<Event> new_events_;  // the events of this tick
  std::vector<Sign> signs_;        // at the end of the last tick
};

}  // namespace understudy::emulator::world
