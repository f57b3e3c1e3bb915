// The only place where a tick is divided. The axes of a device, and the path that carries some of them, move
// from edge to edge. Everything that an edge reads, sets or stops, on its own axis or on other axes, has the
// value of that moment.
//
//   X  ├────────────●─────────────────────┤     ● an edge; its owner is notified, and acts
//   Y  ├────────────┊──────────●──────────┤     ┊ and brings the other axes to this moment
//   path ├───────────────────┊─────┊──────┤
//   owner ├────────────────────────●──────┤     ● a moment that the owner has found between the edges
//
// Edges are handled in the order of their moments (kMoments in motion/axis.h); at equal moments, the owner's
// own moments come first, then the edges of the axes in order, then those of the path. Edges that an action
// causes at its own moment come next. If nothing can happen in the tick, each axis is stepped separately, at
// no extra cost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "motion/axis.h"
#include "motion/axis_tick.h"
#include "motion/coordinated.h"
#include "motion/path_tick.h"
#include "motion/pulse_drive.h"

namespace understudy::motion {

class SharedTick;

/// The owner of the axes, which acts when something happens to one of them.
class EdgeOwner {
 public:
  /// Called at tick.now(), the moment that `axis` has reached. Use tick.bring() to move other axes to it.
  virtual void at_edge(SharedTick& tick, std::size_t axis, Events events) = 0;
  /// Returns the first moment from tick.now() to `until` at which something happens that the axes cannot
  /// detect, such as a change of a number that the owner computes from several axes. No edge comes before
  /// `until`. This is called only in ticks with TickOfAxes::watched.
  virtual std::optional<Instant> next_moment(SharedTick& /*tick*/, const Instant& /*until*/) { return {}; }
  /// Called at that moment. next_moment() must not find the same event again.
  virtual void at_moment(SharedTick& /*tick*/) {}

 protected:
  ~EdgeOwner() = default;
};

/// A tick of several axes. The spans have one element per axis. The pulses sent are added to `pulses`, with
/// the sign of the output.
struct TickOfAxes {
  Tick tick = 0;
  std::span<Axis> axes;
  std::span<const Environment> environment;
  std::span<std::int64_t> pulses;
  std::uint32_t watched = 0;  // mask of the axes whose values between edges the owner needs
};

/// Steps the axes in the mask `singles`, which no path carries, and the axes that `path` carries (null:
/// none). There can be at most SharedTick::kMax axes. `owner` may be null.
void step_together(const TickOfAxes& all, std::uint32_t singles, Coordinated* path, EdgeOwner* owner,
                   bool stays_engaged = false);

/// The functions that the owner can call while it acts. Bring an axis to this moment before you change it,
/// and change it only for this moment.
class SharedTick {
 public:
  static constexpr std::size_t kMax = 4;

  Instant now() const { return now_; }
  Tick tick() const { return all_.tick; }
  std::span<Axis> axes() const { return all_.axes; }
  /// Returns the axis's pulses of the whole tick; valid for events at the end of the tick.
  std::int64_t pulses(std::size_t axis) const { return all_.pulses[axis]; }
  /// Brings an axis to the present moment, together with all axes of its path.
  void bring(std::size_t axis);
  /// Returns where a watched axis will be at a later moment if no edge comes before it.
  AxisPlace place_ahead(std::size_t axis, const Instant& at);
  /// Brings the path to the present moment and slows it down by the ramps of `by`.
  void slow_path(Cause why, const SpeedLaw& by);

 private:
  friend void step_together(const TickOfAxes& all, std::uint32_t singles, Coordinated* path, EdgeOwner* owner,
                            bool stays_engaged);

  struct Member {
    std::size_t axis = 0;
    bool is_on_path = false;
    bool is_quiet = false;
    Axis::QuietTick quiet{};
    std::optional<AxisTick> part{};
  };

  SharedTick(const TickOfAxes& all, Coordinated* path, EdgeOwner* owner) noexcept
      : all_(all), path_(path), owner_(owner) {}

  void run(bool stays_engaged);
  void open(Member& member);
  void open_path();
  Member* member_of(std::size_t axis);
  bool step_first();
  void handle_events();
  template <class Act>
  void act(const Act& by_owner);
  bool step_owner(const Instant& until);
  void finish();

  const TickOfAxes& all_;
  Coordinated* path_;
  EdgeOwner* owner_;
  std::array<Member, kMax> members_{};
  std::size_t count_ = 0;
  std::optional<Coordinated::Ahead> ahead_{};
  bool stays_engaged_ = false;
  std::optional<PathTick> path_tick_{};
  Instant now_{};
  bool is_closed_ = false;
};

}  // namespace understudy::motion
