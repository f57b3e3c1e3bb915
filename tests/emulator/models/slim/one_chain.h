// A chain of eight modules on a bench, and the closed forms with which it is compared.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "emulator/models/slim/chain/chain.h"

namespace understudy::emulator::models::slim {

/// The duration of a move from rest to rest over `length`, with at most `speed` and the acceleration `slope`.
struct Trapezoid {
  double length, speed, slope;

  double top() const { return std::min(speed, std::sqrt(length * slope)); }
  /// L/v + v/a, or 2 sqrt(L/a).
  double duration_s() const { return length / top() + top() / slope; }
  double at(double t_s) const {
    const double ramp_s = top() / slope;
    if (t_s <= 0) return 0;
    if (t_s >= duration_s()) return length;
    if (t_s < ramp_s) return slope * t_s * t_s / 2;
    if (t_s > duration_s() - ramp_s) return length - slope * std::pow(duration_s() - t_s, 2) / 2;
    return top() * (t_s - ramp_s / 2);
  }
};

/// Returns the tick by which a duration is over, apart from rounding.
inline Tick ticks_of(double seconds) { return static_cast<Tick>(std::ceil(seconds * 1000 - 1e-6)); }

struct OneChain {
  Chain chain;
  Tick tick = 0;
  std::array<std::int64_t, kModules> sent{};  // all pulses so far, as they were sent

  explicit OneChain(const ChainOptions& options = {}) : chain(options) {
    for (int module = 0; module < kModules; ++module) chain.settings().set_linked(module, true);
  }

  /// TX=0, TY=1 ...
  void map(std::initializer_list<int> modules) {
    for (int letter = 0; letter < kLetters; ++letter) {
      chain.assign(static_cast<Letter>(letter), kUnassigned);
    }
    int letter = 0;
    for (const int module : modules) chain.assign(static_cast<Letter>(letter++), module);
  }
  void scale_all(std::int64_t pulses_per_unit) {
    for (int module = 0; module < kModules; ++module) chain.settings().set_scale(module, pulses_per_unit, 1);
  }
  /// VM and VA in pulses, with 10000 per revolution.
  void speeds(int module, double pps, double pps2) {
    chain.settings().set_speed_unit(module, SpeedUnit::rps);
    chain.settings().set_working_speed(module, pps / 10'000);
    chain.settings().set_acceleration(module, pps2 / 10'000);
  }
  void jog_speed(int module, double pps) {
    chain.settings().set_speed_unit(module, SpeedUnit::rps);
    chain.settings().set_jog_speed(module, pps / 10'000);
  }

  void step() {
    chain.step(++tick);
    for (int module = 0; module < kModules; ++module) {
      sent[static_cast<std::size_t>(module)] += chain.module_at(module).sent_pulses;
    }
  }
  void steps(Tick count) {
    for (; count > 0; --count) step();
  }
  bool all_done() const {
    for (int module = 0; module < kModules; ++module) {
      if (!chain.done(module)) return false;
    }
    return true;
  }
  /// Returns the tick in which all motion was finished.
  Tick finish(Tick max = 200'000) {
    for (const Tick last = tick + max; !all_done() && tick < last;) step();
    return tick;
  }

  Error line(std::initializer_list<double> units, bool absolute = false) {
    return chain.line({units.begin(), units.size()}, absolute);
  }
  std::int64_t travel(int module) const { return chain.axis(module).travel_pulses; }
};

}  // namespace understudy::emulator::models::slim
