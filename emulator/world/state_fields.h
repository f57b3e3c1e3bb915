// What the state of a world consists of, for snapshot.cpp: all fields, in order. A field that is added and
// not listed here is a compile error, because a structured binding names every field.
#pragma once

#include "base/state/state_bytes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

/// A world, its machines and lines; devices and stations have lists of their own.
struct WorldFields {
  static auto of(Like<World> auto& world, auto visit) {
    // What it is made of, and who looks at it, is not a state. Devices, machines and lines are parts of their
    // own, how often ticks were run is of the edge.
    auto& [known, devices, axes, lines, text_lines, plants, contacts, sent_pulses, inputs, supplies, wires,
           watchers, listener, faults, next_fault, fault_watch, seed, disturbed, now, done, ticks_run,
           ticks_crossed, bulk_ticks, crossing_tries] = world;
    return visit(sent_pulses, inputs, supplies, faults, next_fault, disturbed, now, done);
  }
  static auto& plants(Like<World> auto& world) { return world.plants_; }
  // clang-format off
  static void of(Like<World::Input> auto& v, auto visit) { auto& [a, b, c, d] = v; visit(a, b, c, d); }
  static void of(Like<World::Supply> auto& v, auto visit) { auto& [a] = v; visit(a); }
  static void of(Like<Fault> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = v; visit(a, b, c, d, e, f, g, h, i, j, k);
  }
  static void of(Like<FaultTrigger> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = v; visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  }
  static void of(Like<FaultCourse> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j] = v; visit(a, b, c, d, e, f, g, h, i, j);
  }
  static void of(Like<ArmedFault> auto& v, auto visit) { auto& [a, b] = v; visit(a, b); }
  static void of(Like<MachineFaults> auto& v, auto visit) { auto& [a, b, c, d, e] = v; visit(a, b, c, d, e); }
  static void of(Like<PlantAxis::State> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = v;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  }

  static void of(Like<pty::LineSettings> auto& v, auto visit) {
    auto& [a, b, c, d] = v; visit(a, b, c, d);
  }
  static void of(Like<pty::HostSettings> auto& v, auto visit) { auto& [a, b] = v; visit(a, b); }
  static void of(Like<pty::TimedByte> auto& v, auto visit) { auto& [a, b, c, d] = v; visit(a, b, c, d); }
  static void of(Like<pty::Line::Burst> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }
  static void of(Like<pty::Line::State::Member> auto& v, auto visit) {
    auto& [a, b, c] = v; visit(a, b, c);
  }
  static void of(Like<pty::Line::State> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, output, counters, clock] = v;
    visit(a, b, c, d, e, f, g, h, i, j, k, l);
  }
  // clang-format on

  static void rearm(World& world) { world.arm_faults(); }

  static constexpr Fault::Kind last(Fault::Kind) { return Fault::Kind::collision; }
  static constexpr Fault::Side last(Fault::Side) { return Fault::Side::both; }
  static constexpr pty::Parity last(pty::Parity) { return pty::Parity::even; }

  static void check(const auto&) {}  // only the whole tells what may be: snapshot.cpp
};

/// What the model does not do things by: what hosts and observers leave behind, and how ticks were run.
struct EdgeFields {
  static auto of(Like<World> auto& world, auto visit) {
    auto& [known, devices, axes, lines, text_lines, plants, contacts, sent_pulses, inputs, supplies, wires,
           watchers, listener, faults, next_fault, fault_watch, seed, disturbed, now, done, ticks_run,
           ticks_crossed, bulk_ticks, crossing_tries] = world;
    return visit(ticks_run, ticks_crossed);
  }
  static void of(Like<pty::Line::State> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, output, counters, clock] = v;
    visit(output, counters, clock);
  }
  static void of(Like<pty::LineCounters> auto& v, auto visit) {
    auto& [a, b, c, d, e] = v;
    visit(a, b, c, d, e);
  }
  static void check(const auto&) {}
};

}  // namespace understudy::emulator::world
