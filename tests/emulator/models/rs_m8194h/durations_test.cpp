// The durations of moves, to the tick, by closed forms of the chip's laws (7.1): moves too short for their
// speed, offsets of the deceleration, constant speeds, both directions; and the positions of whole moves at
// every tick.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace durations_test {

enum class Ends : std::uint8_t {
  on_time,       // deceleration begins so as to reach SV at the target, or AO pulses before it
  half_constant  // AVTRI: the ramps take half of the distance
};

struct Move {
  int mode;         // of NORMAL_SPEED: 0 T, 1 S, 2 T with separate ramps, 3 S likewise
  double distance;  // pulses
  double sv, v;     // pulses per second
  double up, down;  // A and D, or K and L
  double ao;        // pulses
  Ends ends = Ends::on_time;
};

bool is_s(const Move& move) { return move.mode == 1 || move.mode == 3; }

double ramp_s(const Move& move, double peak, double rate) {
  return is_s(move) ? 2 * std::sqrt((peak - move.sv) / rate) : (peak - move.sv) / rate;
}
/// The speed rises linearly, or in two equal parabolas: its mean is that of its ends.
double ramp_pulses(const Move& move, double peak, double rate) {
  return (peak + move.sv) / 2 * ramp_s(move, peak, rate);
}

/// Returns the highest speed at which both ramps fit into this many pulses, by bisection; at most V.
double peak_pps(const Move& move, double pulses) {
  double low = move.sv;
  double high = move.v;
  const auto fits = [&](double peak) {
    return ramp_pulses(move, peak, move.up) + ramp_pulses(move, peak, move.down) <= pulses;
  };
  if (fits(high)) return high;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

double seconds_of(const Move& move) {
  if (move.v <= move.sv) return move.distance / move.v;
  if (move.ao >= move.distance) return move.distance / move.sv;
  if (move.ao < 0) {
    // Too late: a T-curve ends at the speed that its ramp has reached.
    const double cut = ramp_pulses(move, move.v, move.down) + move.ao;
    const double end = std::sqrt(move.v * move.v - 2 * move.down * cut);
    const double even = move.distance - ramp_pulses(move, move.v, move.up) - cut;
    return ramp_s(move, move.v, move.up) + even / move.v + (move.v - end) / move.down;
  }
  const double way = move.distance - move.ao;
  const double peak = peak_pps(move, move.ends == Ends::half_constant ? way / 2 : way);
  const double ramps = ramp_pulses(move, peak, move.up) + ramp_pulses(move, peak, move.down);
  return ramp_s(move, peak, move.up) + ramp_s(move, peak, move.down) + (way - ramps) / peak +
         move.ao / move.sv;
}

constexpr Move kMoves[] = {
    // T, too short for V
    {0, 3000, 1000, 10000, 20000, 20000, 0},
    {0, 500, 500, 8000, 4000, 4000, 0},
    {0, 17, 100, 8000, 4000, 4000, 0},
    {0, 1, 500, 8000, 4000, 4000, 0},
    {0, 3000, 1000, 10000, 20000, 20000, 8},
    {2, 3000, 1000, 10000, 20000, 60000, 0},
    {2, 3000, 1000, 10000, 50000, 15000, 0},
    {2, 3000, 1000, 10000, 50000, 15000, 25},
    // exactly at the limit: both ramps just fit
    {0, 4950, 1000, 10000, 20000, 20000, 0},
    // S, too short for V
    {1, 3000, 1000, 10000, 50000, 50000, 0},
    {1, 200, 500, 10000, 80000, 80000, 0},
    {1, 3000, 1000, 10000, 50000, 50000, 8},
    {3, 3000, 1000, 10000, 50000, 120000, 0},
    {3, 3000, 1000, 10000, 120000, 50000, 0},
    {3, 5000, 1000, 10000, 120000, 50000, 10},
    // AVTRI keeps half of a short T constant; long moves are unchanged
    {0, 3000, 1000, 10000, 20000, 20000, 0, Ends::half_constant},
    {2, 3000, 1000, 10000, 20000, 60000, 0, Ends::half_constant},
    {0, 30000, 1000, 10000, 20000, 20000, 0, Ends::half_constant},
    // AO covers the whole distance
    {0, 15, 500, 8000, 4000, 4000, 20},
    {0, 20, 500, 8000, 4000, 4000, 20},
    // AO below 0: cut off
    {0, 20000, 1000, 10000, 20000, 20000, -60},
    {2, 20000, 1000, 10000, 40000, 15000, -500},
    // constant
    {0, 4321, 2000, 2000, 4000, 4000, 0},
    {1, 4321, 2000, 1000, 50000, 50000, 8},
    {3, 1, 2000, 1000, 50000, 50000, 0},
};

std::string number(double value) { return std::to_string(static_cast<long long>(value)); }

TEST(RsM8194hDurations, AreThoseOfTheClosedForms) {
  for (const Move& move : kMoves) {
    for (const int direction : {+1, -1}) {
      OneRsm rsm;
      const std::string up = is_s(move) ? "K" : "A";
      const std::string down = is_s(move) ? "L" : "D";
      rsm.send("RSM_NORMAL_SPEED Y " + number(move.mode));
      rsm.send("RSM_SET_SV Y " + number(move.sv));
      rsm.send("RSM_SET_V Y " + number(move.v));
      rsm.send("RSM_SET_" + up + " Y " + number(move.up));
      rsm.send("RSM_SET_" + down + " Y " + number(move.down));
      rsm.send("RSM_SET_AO Y " + number(move.ao));
      if (move.ends == Ends::half_constant) rsm.send("RSM_AVTRI_ENABLE Y");
      rsm.run(1);
      rsm.send("RSM_FIXED_MOVE Y " + number(direction * move.distance));
      const auto ticks = static_cast<Tick>(std::ceil(seconds_of(move) * 1000 - 1e-6)) + 1;
      SCOPED_TRACE("mode " + number(move.mode) + ", " + number(direction * move.distance) + " pulses, V " +
                   number(move.v) + ", AO " + number(move.ao));
      EXPECT_EQ(rsm.run_to_rest(), ticks);
      EXPECT_EQ(rsm.get("LP_Y"), direction * move.distance);
    }
  }
}

constexpr double kRounding = 1e-6;

/// A ramp from one speed to a higher one, in pulses after this many seconds: linear, or in two equal
/// parabolas.
struct Ramp {
  bool is_s = false;
  double low = 0, high = 0;  // pulses per second
  double rate = 0;           // A, or K

  double lasts() const { return is_s ? 2 * std::sqrt((high - low) / rate) : (high - low) / rate; }
  double pulses() const { return (low + high) / 2 * lasts(); }
  double at(double t) const {
    if (!is_s) return low * t + rate * t * t / 2;
    if (t <= lasts() / 2) return low * t + rate * t * t * t / 6;
    const double left = lasts() - t;
    return pulses() - (high * left - rate * left * left * left / 6);
  }
};

/// A move that reaches V.
struct Law {
  int mode = 0;  // of NORMAL_SPEED
  double sv = 0, v = 0;
  double up = 0, down = 0;  // A and D, or K and L

  Ramp rising() const { return {mode == 1 || mode == 3, sv, v, up}; }
  Ramp falling() const { return {mode == 1 || mode == 3, sv, v, down}; }
  double seconds(double distance) const {
    return rising().lasts() + falling().lasts() + (distance - rising().pulses() - falling().pulses()) / v;
  }
  /// Pulses after this many seconds.
  double at(double t, double distance) const {
    const double left = seconds(distance) - t;
    if (left <= 0) return distance;
    if (t < rising().lasts()) return rising().at(t);
    if (left < falling().lasts()) return distance - falling().at(left);
    return rising().pulses() + (t - rising().lasts()) * v;
  }
};
constexpr Law kLaws[] = {
    {0, 500, 8000, 20000, 20000},    {0, 8000, 8000, 20000, 20000}, {1, 500, 8000, 90000, 90000},
    {2, 1000, 10000, 40000, 15000},  {2, 100, 10000, 9000, 60000},  {3, 1000, 10000, 60000, 250000},
    {3, 1000, 10000, 250000, 60000},
};
constexpr double kDistance = 15000;

TEST(RsM8194hDurations, AreWhereTheirLawSaysAtEveryTick) {
  for (const Law& law : kLaws) {
    for (const int direction : {+1, -1}) {
      OneRsm rsm;
      const bool is_s = law.mode == 1 || law.mode == 3;
      rsm.send("RSM_NORMAL_SPEED Z " + number(law.mode));
      rsm.send("RSM_SET_SV Z " + number(law.sv));
      rsm.send("RSM_SET_V Z " + number(law.v));
      rsm.send((is_s ? "RSM_SET_K Z " : "RSM_SET_A Z ") + number(law.up));
      rsm.send((is_s ? "RSM_SET_L Z " : "RSM_SET_D Z ") + number(law.down));
      rsm.send("RSM_SET_AO Z 0");
      rsm.run(1);
      rsm.send("RSM_FIXED_MOVE Z " + number(direction * kDistance));
      const Tick begin = rsm.now();
      do {
        rsm.run(1);
        const double t = static_cast<double>(rsm.now() - begin - 1) / 1000;  // from the next tick on
        const double should = law.at(t, kDistance);
        // A pulse is sent when its position has been reached.
        const auto is = static_cast<double>(direction * rsm.get("LP_Z"));
        ASSERT_LE(is, should + kRounding) << "mode " << law.mode << " at " << t;
        ASSERT_GT(is, should - 1 - kRounding) << "mode " << law.mode << " at " << t;
      } while (rsm.get("DRIVING_AXIS") != 0);
      EXPECT_EQ(rsm.get("LP_Z"), direction * kDistance);
    }
  }
}

}  // namespace durations_test
}  // namespace understudy::emulator::models::rs_m8194h
