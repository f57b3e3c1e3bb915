// Writes a finding of a hunt as an ordinary scenario.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/hunt/course_player.h"
#include "emulator/hunt/shrinker.h"
#include "emulator/play/reading/hunt_plan.h"

namespace understudy::emulator::hunt {

/// The origin of a finding, for people.
struct Origin {
  std::string command;           // the command that finds it again
  std::string again{};           // the command that runs it, if that is not `run`
  std::uint64_t course = 0;      // the number of the course
  std::size_t disturbances = 0;  // the number of disturbances of the course
};

/// Returns a disturbance in one line: "inject: { drop: feeder, nth: 3 }".
std::string line_of(const play::HuntPlan& plan, const play::Disturbance& disturbance);
/// Returns the name of its file, without folder and extension. The name is always the same for a kind of
/// failure.
std::string name_of_finding(const CoursePlayer& course_player, const Shrunk& found);
/// Returns true if somebody has changed the text of a found file. An empty text is not a found file.
bool is_edited(const std::string& text);
/// Returns the text of a scenario file in that folder. Its first lines contain a checksum, for is_edited().
std::string text_of_finding(const CoursePlayer& course_player, const Shrunk& found, const Origin& origin,
                            const std::string& folder);

}  // namespace understudy::emulator::hunt
