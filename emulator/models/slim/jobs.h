// What waits in a module's FIFO: a command, with everything that was in force when it was issued.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/models/slim/outputs.h"
#include "motion/path.h"
#include "motion/path_run.h"

namespace understudy::emulator::models::slim {

inline constexpr std::int8_t kNoModule = -1;
inline constexpr int kLetters = motion::kPathAxes;  // X, Y, Z, W

/// CM.
enum class ContinuousPath : std::uint8_t { off = 0, on = 1, by_angle = 2 };

struct Job {
  enum class Kind : std::uint8_t {
    move,  // MA, MR, XMA ...: one module
    home,
    line,    // 2MA ... 4MR
    arc,     // AA, AR, and with a third module SAA, SAR
    spiral,  // SPI
    set_coordinate,
    servo,
    output,
  };
  Kind kind = Kind::output;
  // The same in every FIFO that the job is in; 0: no job.
  std::uint64_t number = 0;
  // Which modules had the letters X, Y, Z, W when it was issued. Jobs of one module have it at X.
  std::array<std::int8_t, kLetters> module_of{kNoModule, kNoModule, kNoModule, kNoModule};
  // In the user units of each module: targets or distances; an arc's centre and, at Z, height.
  std::array<double, kLetters> units{};
  bool absolute = true;
  bool height_absolute = true;  // of an arc
  double sweep_deg = 0;
  bool by_radius = false;  // `sweep_deg` is a radius: of an arc to `units`, turning left; where a spiral ends
  double growth_units_turn = 0;
  // Where it will leave its modules: as expected when issued, exact from when it starts.
  std::array<double, kLetters> ends{};
  ContinuousPath continuous = ContinuousPath::off;
  double smooth_corner_deg = 0;           // PR7
  double path_acceleration_units_s2 = 0;  // PR2; 0: as it is when the job starts
  bool servo_on = false;
  bool begun = false;  // of one module: it has moved for it
  OutputOrder output{};

  bool operator==(const Job&) const = default;

  bool coordinated() const { return kind == Kind::line || kind == Kind::arc || kind == Kind::spiral; }
  bool moves() const { return coordinated() || kind == Kind::move || kind == Kind::home; }
  /// The letter of `module`; -1: the job does not use it.
  int letter_of(int module) const;
  int modules() const;
};

/// The geometry of a coordinated job from where it begins. Throws motion::BadMotion if it is impossible.
motion::Path path_of(const Job& job, const motion::Point& begin);

/// How `next` follows `job` when nothing lies between them.
motion::Joint joint_between(const Job& job, const Job& next);

}  // namespace understudy::emulator::models::slim
