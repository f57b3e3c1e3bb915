// A command in a module's FIFO, with all settings that were in effect when it was issued.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/models/slim/motor/outputs.h"
#include "motion/path.h"
#include "motion/path_run.h"

namespace understudy::emulator::models::slim {

inline constexpr std::int8_t kNoModule = -1;
inline constexpr int kLetters = motion::kPathAxes;  // X, Y, Z, W

/// The modes of CM.
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
  // The job has the same number in all its FIFOs; 0: no job.
  std::uint64_t number = 0;
  // The modules to which the letters X, Y, Z, W were assigned when the job was issued. A job for one module
  // has that module at X.
  std::array<std::int8_t, kLetters> module_of{kNoModule, kNoModule, kNoModule, kNoModule};
  // Targets or distances, in the user units of each module. For an arc, the centre and, at Z, the height.
  std::array<double, kLetters> units{};
  bool absolute = true;
  bool height_absolute = true;  // for an arc: true if the height is absolute
  double sweep_deg = 0;
  // `sweep_deg` is a radius: that of an arc that turns left to `units`, or the final radius of a spiral.
  bool by_radius = false;
  double growth_units_turn = 0;
  // Where the job leaves its modules: an estimate when it is issued, exact once it has started.
  std::array<double, kLetters> ends{};
  ContinuousPath continuous = ContinuousPath::off;
  double smooth_corner_deg = 0;           // PR7
  double path_acceleration_units_s2 = 0;  // PR2; 0: the value when the job starts
  bool servo_on = false;
  bool begun = false;  // for a job of one module: the motion has begun
  OutputOrder output{};

  bool operator==(const Job&) const = default;

  bool coordinated() const { return kind == Kind::line || kind == Kind::arc || kind == Kind::spiral; }
  bool moves() const { return coordinated() || kind == Kind::move || kind == Kind::home; }
  /// Returns the letter index of `module`, or -1 if the job does not use it.
  int letter_of(int module) const;
  int modules() const;
};

/// Returns the geometry of a coordinated job, from its beginning. Throws motion::BadMotion if it is
/// impossible.
motion::Path path_of(const Job& job, const motion::Point& begin);

/// Returns how `next` follows `job` if no other command lies between them.
motion::Joint joint_between(const Job& job, const Job& next);

}  // namespace understudy::emulator::models::slim
