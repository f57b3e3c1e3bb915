// Makes a failed course smaller, as long as it fails in the same way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "emulator/hunt/course.h"
#include "emulator/hunt/course_player.h"

namespace understudy::emulator::hunt {

struct Shrunk {
  Course course;
  Outcome outcome;
  int plays = 0;            // the number of courses played
  bool is_minimal = false;  // each of its disturbances is needed for that failure
};

class Shrinker {
 public:
  /// `kind` is the kind of the course's failure. Both arguments must outlive the shrinker.
  Shrinker(CoursePlayer& course_player, const std::string& kind)
      : course_player_(course_player), kind_(kind) {}

  Shrunk shrink(const Course& course, const Outcome& outcome);

 private:
  static constexpr int kMaxPlays = 3000;

  bool fails(const Course& course);
  /// Keeps the course if it fails in the same way.
  bool try_course(Course course);
  void end_early();
  bool try_without(std::size_t number);
  bool remove_disturbances();
  void simplify(std::size_t number);
  void lower(std::size_t number, std::uint64_t low, std::uint64_t high,
             const std::function<void(play::Disturbance&, std::uint64_t)>& set);
  void round_moment(std::size_t number);
  std::vector<std::string> ends_without(const Course& course);
  void leave_out_steps();
  bool is_minimal();

  CoursePlayer& course_player_;
  const std::string& kind_;
  Shrunk best_;
};

}  // namespace understudy::emulator::hunt
