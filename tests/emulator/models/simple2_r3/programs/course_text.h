// Courses as text: the table of an expected course, and two courses side by side.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "base/simulated_time.h"

namespace understudy::emulator::models::simple2_r3 {

/// Lists each ms in which anything happens.
using Course = std::map<Tick, std::set<std::string>>;

/// Throws std::invalid_argument for a line that does not have the form of course.h.
Course course_of_table(std::string_view table);

/// "  1004  -D1 L6\n", for all ms from `from` on, `count` lines at most.
std::string to_string(const Course& course, Tick from, int count);

/// Returns the first ms in which the courses differ, or -1 if they are equal.
Tick first_difference(const Course& a, const Course& b);

}  // namespace understudy::emulator::models::simple2_r3
