// Writes courses and their outcomes as bytes, to pass them from one process to another.
#pragma once

#include <cstdint>
#include <utility>

#include "base/state/state_bytes.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/course_player.h"
#include "emulator/hunt/reach.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/results/result_state.h"

template <>
struct understudy::StateOf<understudy::emulator::play::Disturbance::When> {
  using When = emulator::play::Disturbance::When;
  static constexpr When last = When::late;
};

template <>
struct understudy::StateOf<understudy::emulator::play::Disturbance> {
  using Disturbance = emulator::play::Disturbance;
  static constexpr auto fields =
      FieldList{field<&Disturbance::entry>(), field<&Disturbance::step>(), field<&Disturbance::when>(),
                field<&Disturbance::moment>(), field<&Disturbance::values>()};
};

template <>
struct understudy::StateOf<understudy::emulator::hunt::Course> {
  using Course = emulator::hunt::Course;
  static void write(const Course& course, StateWriter& writer) {
    writer.write(course.case_number);
    writer.write(course.disturbances);
    writer.write(static_cast<std::uint64_t>(course.left_out.size()));
    for (const std::size_t step : course.left_out) writer.write(step);
    writer.write(course.end);
  }
  static void read(Course& course, StateReader& reader) {
    reader.read(course.case_number);
    reader.read(course.disturbances);
    std::uint64_t count = 0;
    reader.read(count);
    course.left_out.clear();
    for (; count > 0; --count) {
      std::size_t step = 0;
      reader.read(step);
      course.left_out.insert(step);
    }
    reader.read(course.end);
  }
};

template <>
struct understudy::StateOf<understudy::emulator::hunt::Playing> {
  using Playing = emulator::hunt::Playing;
  static void write(const Playing& playing, StateWriter& writer) {
    writer.write(playing.results);
    writer.write(playing.requests);
    writer.write(static_cast<std::uint64_t>(playing.reached.when.size()));
    for (const auto& [feature, when] : playing.reached.when) {
      writer.write(feature);
      writer.write(when);
    }
  }
  static void read(Playing& playing, StateReader& reader) {
    reader.read(playing.results);
    reader.read(playing.requests);
    std::uint64_t count = 0;
    reader.read(count);
    playing.reached.when.clear();
    for (; count > 0; --count) {
      std::pair<emulator::hunt::Feature, SimTime> one;
      reader.read(one.first);
      reader.read(one.second);
      playing.reached.when.insert(one);
    }
  }
};
