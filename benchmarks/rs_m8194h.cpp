// Measures the cost of an RS-M8194H: a tick with four moving axes and a running macro, alone and among 1,000
// devices, and a tick with a stream of three axes and two synchronous actions, both compared with the bare
// arithmetic of four axes; a device at rest, which is fast-forwarded; its memory; and a snapshot with its
// restore, with empty and with full macros.
#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/big_devices.h"
#include "benchmarks/figures.h"
#include "benchmarks/process.h"
#include "benchmarks/processor_clock.h"
#include "emulator/world/world.h"
#include "interpreter/rs_m8194h/macro.h"

namespace understudy::benchmarks {

namespace {

using emulator::world::World;

constexpr int kRounds = 21;
constexpr Tick kTicks = 20'000;  // in a round
constexpr Tick kWarmUp = 5000;
constexpr Tick kHour = 3'600'000;
constexpr std::size_t kCrowd = 1000;
constexpr Tick kTicksOfCrowd = 100;

constexpr double kMovesBar = 40;    // bare loops
constexpr double kStreamBar = 70;   // bare loops
constexpr double kRestBar = 0.1;    // bare loops per tick
constexpr double kBusyBar = 3'000;  // simulated seconds per second
constexpr double kCrowdBar = 2.5;
constexpr double kBytesBar = 256 * 1024;
constexpr double kSnapshotBar_us = 150;
constexpr double kFullSnapshotBar_us = 500;

/// Four axes go back and forth while the macro counts.
constexpr const char* kMoves =
    "MP 91\n"
    "RSM_MACRO_SET_SV XYZU 1000\nRSM_MACRO_SET_V XYZU 10000\nRSM_MACRO_SET_A XYZU 20000\n"
    "RSM_MACRO_LABEL 0\n"
    "RSM_MACRO_FIXED_MOVE XYZU 40000\n"
    "RSM_MACRO_FOR 2000\nRSM_MACRO_VAR_CALCULATE VAR1 + 1 VAR1\nRSM_MACRO_TIMER 1\nRSM_MACRO_NEXT\n"
    "RSM_MACRO_FIXED_MOVE XYZU -40000\n"
    "RSM_MACRO_FOR 2000\nRSM_MACRO_VAR_CALCULATE VAR1 + 1 VAR1\nRSM_MACRO_TIMER 1\nRSM_MACRO_NEXT\n"
    "RSM_MACRO_GOTO 0\nEND\n";

/// An endless stream around a triangle in space. In each round, X and Y latch and send a pulse.
constexpr const char* kStream =
    "MP 91\n"
    "RSM_MACRO_SYNC_ACTION X X 1 0 1 0 1 0 0 0 0 0\nRSM_MACRO_SYNC_ACTION Y Y 4 0 2 0 1 0 0 0 0 0\n"
    "RSM_MACRO_SET_COMPARE X 0 0 500\nRSM_MACRO_SET_COMPARE Y 1 1 400\n"
    "RSM_MACRO_SET_MAX_V XYZ 80000\n"
    "RSM_MACRO_LINE_3D_INITIAL X Y Z 1000 10000 100000\n"
    "RSM_MACRO_LABEL 0\n"
    "RSM_MACRO_LINE_3D_CONTINUE 0 1000 0 500\nRSM_MACRO_LINE_3D_CONTINUE 0 -500 1000 0\n"
    "RSM_MACRO_LINE_3D_CONTINUE 0 -500 -1000 -500\n"
    "RSM_MACRO_GOTO 0\nEND\n";

constexpr int kMacro = 91;

/// The minimum work of a tick of four axes (one "bare loop"): for each, a cubic, two comparisons with limits,
/// and a count.
struct BareAxis {
  double place, first, second, third, low, high;
  std::int64_t pulses;
};

double bare_ns() {
  std::array<BareAxis, 4> axes{};
  for (std::size_t a = 0; a < axes.size(); ++a) {
    axes[a] = {0, 10 + static_cast<double>(a), 0.001, 1e-9, -1e15, 1e15, 0};
  }
  constexpr Tick kLoops = 100'000;
  const auto before = processor_time_here();
  for (Tick tick = 1; tick <= kLoops; ++tick) {
    const auto k = static_cast<double>(tick);
    for (BareAxis& axis : axes) {
      const double place = axis.place + k * (axis.first + k * (axis.second + k * axis.third));
      if (place >= axis.low && place <= axis.high) axis.pulses = static_cast<std::int64_t>(place);
    }
    asm volatile("" : : "g"(&axes) : "memory");  // computes tick after tick, and stores all of it
  }
  return static_cast<double>((processor_time_here() - before).count()) / kLoops;
}

std::unique_ptr<World> make_world(std::size_t devices, const std::string& program) {
  return make_devices(devices, "rs-m8194h", program, 0, [](auto& device, std::size_t d) {
    device.settings.address = static_cast<int>(d % kStationsALine) + 1;
  });
}

/// Throws if the world does not do the work that should be measured.
void expect_busy(World& world, emulator::Value driving) {
  for (std::size_t d = 0; d < world.device_count(); ++d) {
    if (get(world.device(d), "DRIVING_AXIS") != driving) throw CannotRun("axes are at rest that should move");
  }
}

std::unique_ptr<World> make_busy(std::size_t devices, const char* program, emulator::Value driving) {
  auto world = make_world(devices, program);
  for (std::size_t d = 0; d < devices; ++d) set(world->device(d), "CALL_MP", kMacro);
  world->advance_to(time_of(kWarmUp));
  expect_busy(*world, driving);
  return world;
}

void measure_ticks() {
  constexpr emulator::Value kAllAxes = 15;
  constexpr emulator::Value kThreeAxes = 7;
  const auto moves = make_busy(1, kMoves, kAllAxes);
  const auto stream = make_busy(1, kStream, kThreeAxes);
  const auto crowd = make_busy(kCrowd, kMoves, kAllAxes);
  Tick done_by_moves = kWarmUp;
  Tick done_by_stream = kWarmUp;
  Tick done_by_crowd = kWarmUp;
  std::vector<double> bare, of_moves, of_stream, in_crowd, moves_in_bare, stream_in_bare, crowd_ratios;
  for (int round = 0; round < kRounds; ++round) {
    bare.push_back(bare_ns());
    of_moves.push_back(ticks_ns(*moves, done_by_moves, kTicks));
    of_stream.push_back(ticks_ns(*stream, done_by_stream, kTicks));
    in_crowd.push_back(ticks_ns(*crowd, done_by_crowd, kTicksOfCrowd));
    moves_in_bare.push_back(of_moves.back() / bare.back());
    stream_in_bare.push_back(of_stream.back() / bare.back());
    crowd_ratios.push_back(in_crowd.back() / of_moves.back());
  }
  expect_busy(*stream, kThreeAxes);
  std::printf("a tick: bare %.1f ns, moves and a macro %.0f ns, among %zu %.0f ns, a stream %.0f ns\n",
              median(bare), median(of_moves), kCrowd, median(in_crowd), median(of_stream));
  print_verdict("four axes in moves and a macro, relative to a bare loop", median(moves_in_bare), kMovesBar);
  print_verdict("a stream of three axes, two actions, relative to a bare loop", median(stream_in_bare),
                kStreamBar);
  print_verdict("a device's tick among 1,000, relative to its tick alone", median(crowd_ratios), kCrowdBar);
  const double simulated = 1e6 / median(of_moves);  // a tick is a millisecond
  std::printf("busy: %.0f simulated seconds per second\n", simulated);
  print_verdict("3,000 simulated seconds per second, relative to that rate", kBusyBar / simulated, 1.00);
}

void measure_rest() {
  std::vector<double> ratios;
  std::vector<double> all_ns;
  for (int round = 0; round < 5; ++round) {
    const double loop_ns = bare_ns();
    const auto world = make_world(1, kMoves);
    Tick done = kWarmUp;
    world->advance_to(time_of(done));
    all_ns.push_back(ticks_ns(*world, done, kHour));
    ratios.push_back(all_ns.back() / loop_ns);
  }
  std::printf("an hour at rest: %.0f us\n", median(all_ns) * static_cast<double>(kHour) / 1000);
  print_verdict("an hour at rest, per tick, relative to a bare loop", median(ratios), kRestBar);
}

/// Returns all macros, each with as many lines as fit.
std::string full_macros() {
  namespace lang = interpreter::rs_m8194h;
  std::string text;
  for (const bool is_isr : {false, true}) {
    const int count = is_isr ? 20 : 157;
    for (int number = 1; number <= count; ++number) {
      text += (is_isr ? "ISR " : "MP ") + std::to_string(number) + "\n";
      for (int line = 0; line < lang::capacity_of({.is_isr = is_isr, .number = number}); ++line) {
        text += "RSM_MACRO_SET_VAR VAR" + std::to_string(line % 512) + " " +
                std::to_string(number * 1000 + line) + "\n";
      }
      text += "END\n";
    }
  }
  return text;
}

void measure_memory() {
  constexpr std::size_t kMany = 100;
  const auto first = make_busy(1, kMoves, 15);  // now the data that all devices share exists
  const double before = heap_bytes();
  const auto many = make_busy(kMany, kMoves, 15);
  const double each = (heap_bytes() - before) / kMany;
  std::printf("memory of a device: %.0f KiB\n", each / 1024);
  print_verdict("a device, relative to 256 KiB", each / kBytesBar, 1.00);
  const auto full = make_world(1, full_macros());
  full->advance_to(time_of(kWarmUp));
  const double usual_us = snapshot_us(*first, "VAR500");
  const double full_us = snapshot_us(*full, "VAR500");
  std::printf("snapshot and restore: %.0f us, with every macro full %.0f us\n", usual_us, full_us);
  print_verdict("snapshot and restore, relative to 150 us", usual_us / kSnapshotBar_us, 1.00);
  print_verdict("with every macro full, relative to 500 us", full_us / kFullSnapshotBar_us, 1.00);
}

}  // namespace

}  // namespace understudy::benchmarks

int main() {
  using namespace understudy::benchmarks;
  return run_benchmark("rs_m8194h", [] {
    measure_memory();
    measure_ticks();
    measure_rest();
  });
}
