// A run follows several paths, one after another, driven by one profile along their length.
//
//        ┌ chain: no stop in between ──────────┐   ┌ next chain
//   ●────●──────────●╮                     ╭───●   ●─────────●
//                     ╰────────────────────╯   stop
//
// Joined paths make a chain, and a chain has one coordinate: the length travelled along it. Speed, override,
// pause and resume all change the profile along this coordinate, so the place stays on the path however the
// timing changes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/state/fields.h"
#include "motion/move.h"
#include "motion/path.h"
#include "motion/pulse_drive.h"

namespace understudy::motion {

/// How a path follows the previous path.
struct Joint {
  enum class Rule : std::uint8_t {
    stop,        // begins from rest
    join,        // continues without slowing down, whatever the corner; at a sharp corner, the velocity jumps
    join_below,  // like join if the deflection is at most `corner_deg`, otherwise like stop
  };
  Rule rule = Rule::stop;
  double corner_deg = 0;

  bool operator==(const Joint&) const = default;
};

/// Equal corners must count as equal: 45 degrees remain 45 degrees despite rounding.
inline constexpr double kCornerTolerance_deg = 1e-9;

class PathRun {
 public:
  static constexpr std::size_t kMaxPaths = 32;

  /// What happens when a joined path arrives after the run has begun to slow down for its end: either the run
  /// speeds up again, or the path begins from rest (SLIM).
  enum class LateJoint : std::uint8_t { speed_up_again, from_rest };

  bool operator==(const PathRun&) const = default;

  void set_late_joint(LateJoint how) { late_joint_ = how; }

  /// Adds a path to the end of the queue. Throws BadMotion(no_room) when full(). A path that is joined to the
  /// running chain lengthens the chain immediately. `now` is the last tick stepped.
  void append(const Path& path, Joint joint, Tick now);
  bool full() const { return count_ == kMaxPaths; }
  std::size_t queued() const { return count_; }
  /// Returns how many paths will remain after `tick` if nothing changes until then.
  std::size_t queued_after(Tick tick) const;

  /// Sets the speed of the current path and of all later paths. It may be called before a run begins and at
  /// any later time, and takes effect at `now`. Throws the same errors as plan() of motion/move.h if a chain
  /// of some length could not be planned with this law. The acceleration may be changed only at rest;
  /// otherwise BadMotion(out_of_range) is thrown.
  void set_speed(const SpeedLaw& speed, Tick now);
  const SpeedLaw& speed() const { return law_; }
  /// Sets another top speed with the same ramps. It may be called at any time.
  void set_top_speed(double speed_u_s, Tick now);
  /// An open run is a stream: more paths will follow, so it does not slow down for the end of the queue. If
  /// it reaches that end, it ends there at full speed and has run dry; a path that is appended later begins
  /// from rest. A new run is closed. If a run is closed before its end, it slows down for the end as far as
  /// it still can.
  void set_open(bool open, Tick now);
  bool open() const { return open_; }
  /// Returns true if the last path ended at speed because no further path had arrived.
  bool ran_dry() const { return ran_dry_; }
  /// Scales the top speed by a factor from 0 (waits on the path) to 10. Throws BadMotion(out_of_range) for
  /// other factors, and for a top speed that would be too small to plan with.
  void set_override(double factor, Tick now);

  /// Begins the queued paths from rest in the next tick. Further chains, and paths appended later, begin
  /// automatically until abandon() is called.
  void start(Tick now);
  /// Sets the place that step() returns until a path begins. Throws BadMotion(not_finite), or
  /// BadMotion(out_of_range) for a place that differs from the beginning of the first path.
  void stand_at(const Point& place);

  /// Slows down to a standstill on the path and stays there.
  void pause(Tick now);
  /// Continues exactly where the run stopped. If the run is still slowing down, it speeds up again.
  void resume(Tick now);
  /// Drops all paths after the first one at whose end the run can still stop, and stops there. Returns how
  /// many paths are left. If the run has not begun, drops all paths.
  std::size_t shorten(Tick now);
  /// Drops the remaining paths at once, so the velocity becomes 0 abruptly. Call it at rest, unless that is
  /// intended.
  void abandon();

  bool running() const { return running_ && count_ > 0; }  // true while paths remain, paused or not
  bool paused() const { return paused_; }                  // pause() is in effect
  bool at_rest(Tick now) const;                            // true if the speed after tick `now` is 0
  /// Returns the length along the current chain, the speed and the acceleration after tick `now`.
  Sample sample(Tick now) const;
  /// Returns how fast each coordinate changes after tick `now`, in u/s. At a corner, it is the velocity of
  /// the following path.
  Point velocity(Tick now) const;
  double chain_length_u() const { return chain_end_u_; }

  /// The place along a chain as a function of time.
  struct Course {
    Profile profile;
    Tick begin_tick = 0;
    double begin_after_s = 0;
  };
  /// The part of a chain covered in one tick, from its place before the tick to its place after it.
  struct Stretch {
    double to_u = 0;
    std::size_t last_piece = 0;  // ring index of the path on which the stretch ends
    // The course of a chain that ended in this tick. If no chain ended, the run still has the course.
    std::optional<Course> course{};
  };
  /// Runs one tick. Ticks must come in order. Returns the place after the tick, valid until the next call. If
  /// nothing runs, it is the place where the last path ended.
  const Point& step(Tick tick, Stretch* gone = nullptr);
  // The functions below refer to the tick just stepped. They are valid until another call changes the run.
  /// Return the length along the chain at the beginning of the tick, and at a moment.
  double began_at(const Stretch& gone, Tick tick) const { return along_at(gone, {.tick = tick - 1}); }
  double along_at(const Stretch& gone, Instant at) const;
  /// Returns the moment at which the run reaches a length along the chain between the tick's beginning and
  /// `to_u`.
  Instant moment_at(const Stretch& gone, Tick tick, double along_u) const;
  /// Returns the place at this length along the chain.
  Point place_on(const Stretch& gone, double along_u) const;
  /// Returns true if a coordinate may have reversed, as on an arc.
  bool bends(const Stretch& gone) const { return pieces_[gone.last_piece].path.kind != Path::Kind::line; }
  /// Returns the end of the span after `along_u` in which each coordinate reverses at most once. The end is
  /// at most `to_u`.
  double end_of_span(const Stretch& gone, double along_u) const;
  /// Returns the direction in which coordinate `i` moves at `along_u`. At a corner, it is the direction of
  /// the following path.
  double direction_at(const Stretch& gone, double along_u, Eigen::Index i) const;
  /// Slows down by the ramps of `by`, beginning at `along_u`, a place that the tick has already passed. The
  /// end of the tick changes accordingly. Returns false and changes nothing if the run is already paused or
  /// has not begun, or the chain has ended.
  bool pause_within(Tick tick, double along_u, const SpeedLaw& by, Stretch& gone);
  /// Returns the number of paths completed in the last tick.
  int completed() const { return completed_; }
  /// Returns the current path, which is the first in the queue.
  const Path& path() const { return pieces_[head_].path; }

  /// Throws BadMotion(out_of_range) if the numbers contradict each other. Used for states that come from
  /// outside.
  void check_queue() const;

 private:
  friend struct StateOf<PathRun>;  // state_fields.h

  struct Piece {
    Path path;
    double begin_u = 0;   // position along its chain
    bool joined = false;  // true if joined to the previous path
    bool operator==(const Piece&) const = default;
  };
  friend struct StateOf<Piece>;

  const Piece& piece_on(const Stretch& gone, double along_u) const;
  Piece& piece(std::size_t number) { return pieces_[(head_ + number) % kMaxPaths]; }
  const Path& path_before(std::size_t number);
  SpeedLaw effective() const;
  bool held() const { return paused_ || override_ == 0; }
  bool keeps_speed_at_end() const { return open_ && chain_count_ == count_; }
  bool slowing_for_the_end(Tick now) const;
  void lay_out_chain(Tick begin_at);
  Profile cut_at_end(Profile profile) const;
  void replan(Tick now);
  double elapsed_s(Tick now) const;
  void drop_front();
  void go_to(double along_u);

  std::array<Piece, kMaxPaths> pieces_{};
  std::size_t head_ = 0;
  std::size_t count_ = 0;
  std::size_t chain_count_ = 0;  // how many paths at the front belong to the current chain
  double chain_end_u_ = 0;
  Profile profile_;
  Tick begin_tick_ = 0;
  double begin_after_s_ = 0;  // the profile begins this long after `begin_tick_`
  SpeedLaw law_;
  double override_ = 1;
  LateJoint late_joint_ = LateJoint::speed_up_again;
  bool running_ = false;
  bool paused_ = false;
  bool open_ = false;
  bool ran_dry_ = false;
  int completed_ = 0;
  Point last_place_ = Point::Zero();
};

}  // namespace understudy::motion
