// Writes a finding of a hunt as an ordinary scenario.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/hunt/course_player.h"
#include "emulator/hunt/shrinker.h"

namespace understudy::emulator::hunt {

/// The origin of a finding, for people.
struct Origin {
  std::string command;           // with which it is found again
  std::string again{};           // the command that runs it, if that is not `run`
  std::uint64_t course = 0;      // its number
  std::size_t disturbances = 0;  // of the course
};

/// Returns the name of its file, without a folder and an ending: always the same one for a kind of failure.
std::string name_of_finding(const CoursePlayer& course_player, const Shrunk& found);
/// Returns the text of a scenario file in that folder.
std::string text_of_finding(const CoursePlayer& course_player, const Shrunk& found, const Origin& origin,
                            const std::string& folder);

}  // namespace understudy::emulator::hunt
