// A run along paths: several, one after another, driven by one profile along their length.
//
//        ┌ chain: run through without stopping ┐   ┌ next chain
//   ●────●──────────●╮                     ╭───●   ●─────────●
//                     ╰────────────────────╯   stop
//
// Paths that are joined make a chain, and a chain is one coordinate: its length so far. Speed, override,
// pause and resume are all changes of the profile along it, so whatever happens in time, the place stays on
// the path.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/state/fields.h"
#include "motion/move.h"
#include "motion/path.h"
#include "motion/pulse_drive.h"

namespace understudy::motion {

/// How a path follows the one before it.
struct Joint {
  enum class Rule : std::uint8_t {
    stop,        // from rest
    join,        // without slowing down, whatever the corner: at a sharp one the velocity jumps
    join_below,  // as join where the deflection is at most `corner_deg`, else as stop
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

  /// A joined path that comes when slowing down for the end has begun: picked up (speeding up again), or
  /// begun from rest as SLIM does.
  enum class LateJoint : std::uint8_t { speed_up_again, from_rest };

  bool operator==(const PathRun&) const = default;

  void set_late_joint(LateJoint how) { late_joint_ = how; }

  /// Adds a path to the end of the queue. Throws BadMotion(no_room) when full(). A path joined to the chain
  /// that runs lengthens it at once; `now` is the last tick stepped.
  void append(const Path& path, Joint joint, Tick now);
  bool full() const { return count_ == kMaxPaths; }
  std::size_t queued() const { return count_; }
  /// How many will be left after `tick`, if nothing is changed until then.
  std::size_t queued_after(Tick tick) const;

  /// The speed of what runs and what comes. Before a run begins, and at any time after, from `now` on. Throws
  /// as motion/move.h's plan(), for a law that a chain of some length could not be planned with. Acceleration
  /// may be changed only at rest: else throws BadMotion(out_of_range).
  void set_speed(const SpeedLaw& speed, Tick now);
  const SpeedLaw& speed() const { return law_; }
  /// Another top speed with the same ramps: at any time.
  void set_top_speed(double speed_u_s, Tick now);
  /// An open run is a stream of which more is to come: it does not slow down for the end of what is queued.
  /// Where that comes, the run ends there at the speed it has, and has run dry; what is appended then begins
  /// from rest. Closed (so it begins) before its end it slows down for it as far as it still can.
  void set_open(bool open, Tick now);
  bool open() const { return open_; }
  /// The last path ended at speed, because no other had come.
  bool ran_dry() const { return ran_dry_; }
  /// Scales the top speed by a factor from 0 (holds, on the path) to 10. Throws BadMotion(out_of_range)
  /// beyond that, and for a top speed that would be too small to plan with.
  void set_override(double factor, Tick now);

  /// Begins what is queued, from rest, in the next tick. Further chains follow by themselves, and what is
  /// appended later begins by itself, until abandon().
  void start(Tick now);
  /// Where it is while nothing has run yet: what step() gives until a path begins. Throws
  /// BadMotion(not_finite), and (out_of_range) for a place that is not where the first path begins.
  void stand_at(const Point& place);

  /// Slows down on the path to a standstill, and stays.
  void pause(Tick now);
  /// Goes on exactly where it was; while still slowing down, speeds up again.
  void resume(Tick now);
  /// Forgets the paths behind the first one at whose end it can still stop, and stops there. Returns how many
  /// are left; what has not begun is forgotten altogether.
  std::size_t shorten(Tick now);
  /// Forgets what is left at once, including the velocity. Call it at rest, unless that is intended.
  void abandon();

  bool running() const { return running_ && count_ > 0; }  // something is not done, paused or not
  bool paused() const { return paused_; }                  // pause() is in force
  bool at_rest(Tick now) const;                            // no speed after tick `now`
  /// Length along the present chain, speed and acceleration after tick `now`.
  Sample sample(Tick now) const;
  /// How fast each coordinate changes there, u/s. On a corner, of the path behind it.
  Point velocity(Tick now) const;
  double chain_length_u() const { return chain_end_u_; }

  /// How the chain's place goes by in time.
  struct Course {
    Profile profile;
    Tick begin_tick = 0;
    double begin_after_s = 0;
  };
  /// What a tick has gone along: of a chain, from its place before the tick to its place after it.
  struct Stretch {
    double to_u = 0;
    std::size_t last_piece = 0;  // where in the ring the path is on which it ends
    // Of a chain that is over in it: how it went. Else the run still knows.
    std::optional<Course> course{};
  };
  /// One tick, in order. The place after it, until the next one; where nothing runs, where the last path
  /// ended.
  const Point& step(Tick tick, Stretch* gone = nullptr);
  // Of the tick just stepped, until something else is asked of the run:
  /// Where it began, and its place along the chain at a moment.
  double began_at(const Stretch& gone, Tick tick) const { return along_at(gone, {.tick = tick - 1}); }
  double along_at(const Stretch& gone, Instant at) const;
  /// The moment at which it comes to a length along the chain between there and `to_u`.
  Instant moment_at(const Stretch& gone, Tick tick, double along_u) const;
  /// The place there.
  Point place_on(const Stretch& gone, double along_u) const;
  /// Whether it may have turned round in a coordinate: on an arc.
  bool bends(const Stretch& gone) const { return pieces_[gone.last_piece].path.kind != Path::Kind::line; }
  /// How far behind that each coordinate keeps its way, but for one turn; at most `to_u`.
  double end_of_span(const Stretch& gone, double along_u) const;
  /// Which way coordinate `i` goes there; on a corner, of the path behind it.
  double way_on(const Stretch& gone, double along_u, Eigen::Index i) const;
  /// Slows down, by the ramps of `by`, from that length on, which the tick has passed: it ends accordingly.
  /// False, and nothing has changed, where it is paused already or the chain is over.
  bool pause_within(Tick tick, double along_u, const SpeedLaw& by, Stretch& gone);
  /// Paths that were completed in the last tick.
  int completed() const { return completed_; }
  /// The path being run; of the queue's front.
  const Path& path() const { return pieces_[head_].path; }

  /// Throws BadMotion(out_of_range) if the numbers contradict each other: for states from outside.
  void check_queue() const;

 private:
  friend struct StateOf<PathRun>;  // state_fields.h

  struct Piece {
    Path path;
    double begin_u = 0;   // along its chain
    bool joined = false;  // to the one before
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
  std::size_t chain_count_ = 0;  // of the front ones, that make the chain being run
  double chain_end_u_ = 0;
  Profile profile_;
  Tick begin_tick_ = 0;
  double begin_after_s_ = 0;  // of the profile, after that tick
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
