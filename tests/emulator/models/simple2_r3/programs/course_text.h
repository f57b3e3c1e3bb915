// Courses as text: the table of an expected one, and two side by side.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "base/simulated_time.h"

namespace understudy::emulator::models::simple2_r3 {

/// What happens in each ms in which anything does.
using Course = std::map<Tick, std::set<std::string>>;

/// Throws std::invalid_argument for a line that is none of course.h's.
Course course_of_table(std::string_view table);

/// "  1004  -D1 L6\n", for all ms from `from` on, `count` lines at most.
std::string to_string(const Course& course, Tick from, int count);

/// The first ms in which they differ; -1 if none.
Tick first_difference(const Course& a, const Course& b);

}  // namespace understudy::emulator::models::simple2_r3
