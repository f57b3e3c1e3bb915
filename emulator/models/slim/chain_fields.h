// What the state of a chain consists of, in the manner of base/state/state_bytes.h: a device's own list
// has
//   static void write(const Chain& chain, StateWriter& writer) { writer.write<ChainFields>(chain); }
//   static void read(Chain& chain, StateReader& reader) { reader.read<ChainFields>(chain); }
#pragma once

#include "base/state/state_bytes.h"
#include "emulator/models/slim/chain.h"

namespace understudy::emulator::models::slim {

struct ChainFields {
  // clang-format off
  static void of(Like<ChainOptions> auto& v, auto visit) {
    auto& [a] = v; visit(a);
  }
  static void of(Like<motion::UnitScale> auto& v, auto visit) { auto& [a, b] = v; visit(a, b); }
  static void of(Like<ModuleSettings> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j] = v; visit(a, b, c, d, e, f, g, h, i, j);
  }
  static void of(Like<Output> auto& v, auto visit) {
    auto& [a, b, c, d, e, f] = v; visit(a, b, c, d, e, f);
  }
  static void of(Like<OutputOrder> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i] = v; visit(a, b, c, d, e, f, g, h, i);
  }
  static void of(Like<PositionTrigger> auto& v, auto visit) {
    auto& [a, b, c, d] = v; visit(a, b, c, d);
  }
  static void of(Like<Job> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = v;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
  }
  static void of(Like<Module> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = v;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t);
  }
  static void of(Like<Chain> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = v; visit(a, b, c, d, e, f, g, h, i, j, k);
  }
  // clang-format on

  static constexpr SpeedUnit last(SpeedUnit) { return SpeedUnit::rps; }
  static constexpr Output::Mode last(Output::Mode) { return Output::Mode::pwm; }
  static constexpr OutputOrder::Kind last(OutputOrder::Kind) { return OutputOrder::Kind::arm; }
  static constexpr Job::Kind last(Job::Kind) { return Job::Kind::output; }
  static constexpr ContinuousPath last(ContinuousPath) { return ContinuousPath::by_angle; }
  static constexpr Activity last(Activity) { return Activity::stopping; }
  static constexpr Error last(Error) { return Error::address; }

  // Types of motion/, and what is saved only as far as it exists.
  static void write(const motion::Axis& axis, StateWriter& writer);
  static void read(motion::Axis& axis, StateReader& reader);
  static void write(const motion::Surroundings& here, StateWriter& writer);
  static void read(motion::Surroundings& here, StateReader& reader);
  static void write(const Chain::Group& group, StateWriter& writer);
  static void read(Chain::Group& group, StateReader& reader);
  static void write(const Fifo<Job, kFifoLength>& fifo, StateWriter& writer);
  static void read(Fifo<Job, kFifoLength>& fifo, StateReader& reader);

  static void check(const ChainOptions& options);
  static void check(const motion::UnitScale& scale);
  static void check(const ModuleSettings& settings);
  static void check(const Output& output);
  static void check(const OutputOrder& order);
  static void check(const PositionTrigger& trigger);
  static void check(const Job& job);
  static void check(const Module& module);
  static void check(const Chain& chain);
};

}  // namespace understudy::emulator::models::slim
