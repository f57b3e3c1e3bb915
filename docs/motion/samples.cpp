// Samples of the motion library's laws, for the pictures of docs/motion.md: writes one table a picture into
// the folder given. Nothing is drawn here that the library did not compute.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <string>

#include "docs/motion/homing_samples.h"
#include "motion/move.h"
#include "motion/path.h"
#include "motion/path_run.h"
#include "motion/profile.h"
#include "motion/ramp.h"
#include "motion/tick.h"

namespace understudy::docs {

namespace {

using namespace understudy::motion;

constexpr int kStepsEach = 40;  // samples of a segment
constexpr double kStep_s = 0.002;

/// A table of numbers; blocks (curves) are separated by two empty lines, as gnuplot's `index` counts them.
std::ofstream table(const std::filesystem::path& folder, const std::string& name) {
  std::ofstream file(folder / (name + ".dat"));
  file.precision(7);
  return file;
}

/// time s, position, speed, acceleration, jerk.
void write_profile(std::ofstream& file, const Profile& profile, double until_s) {
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    const Segment& s = profile.segments[static_cast<std::size_t>(i)];
    const bool last = i + 1 == profile.segment_count;
    const double end_s = std::min(
        until_s, last ? profile.duration_s : profile.segments[static_cast<std::size_t>(i) + 1].begin_s);
    for (int step = 0; step <= kStepsEach; ++step) {
      const double here_s = s.begin_s + (end_s - s.begin_s) * step / kStepsEach;
      const Sample sample = sample_segment(s, here_s - s.begin_s);
      file << here_s << ' ' << sample.position_u << ' ' << sample.speed_u_s << ' ' << sample.acceleration_u_s2
           << ' ' << s.jerk_u_s3 << '\n';
    }
  }
  if (!profile.endless()) {
    file << profile.duration_s << ' ' << profile.end_position_u << " 0 0 0\n";
    file << profile.duration_s + 0.02 << ' ' << profile.end_position_u << " 0 0 0\n";
  }
  file << "\n\n";
}

void picture(const std::filesystem::path& folder, const std::string& name,
             std::initializer_list<Profile> profiles, double until_s = 1e9) {
  std::ofstream file = table(folder, name);
  for (const Profile& profile : profiles) write_profile(file, profile, until_s);
}

void families(const std::filesystem::path& folder) {
  const auto slope = [](double a) { return RampLaw::by_slope(a); };
  picture(
      folder, "trapezoid",
      {plan(8000,
            {.start_speed_u_s = 2000, .top_speed_u_s = 20000, .up = slope(100000), .down = slope(60000)})});
  picture(folder, "by_times",
          {plan(8000, {.top_speed_u_s = 20000, .up = RampLaw::by_time(0.1), .down = RampLaw::by_time(0.2)}),
           plan(1500, {.top_speed_u_s = 20000, .up = RampLaw::by_time(0.1), .down = RampLaw::by_time(0.2)})});
  const SpeedLaw jerk{.start_speed_u_s = 1000,
                      .top_speed_u_s = 20000,
                      .up = RampLaw::by_jerk(2e6),
                      .down = RampLaw::by_jerk(2e6)};
  SpeedLaw unlike = jerk;
  unlike.down = RampLaw::by_jerk(0.7e6);
  picture(folder, "s_curve", {plan(9000, jerk), plan(9000, unlike)});
  const auto sections = [](double section) {
    return SpeedLaw{.start_speed_u_s = 200,
                    .top_speed_u_s = 20000,
                    .up = RampLaw::by_sections(150000, section),
                    .down = RampLaw::by_sections(150000, section)};
  };
  picture(folder, "sections",
          {plan(8000, sections(0)), plan(8000, sections(4000)), plan(8000, sections(9900))});
}

void short_moves(const std::filesystem::path& folder) {
  SpeedLaw law{.start_speed_u_s = 500,
               .top_speed_u_s = 20000,
               .up = RampLaw::by_jerk(2e6),
               .down = RampLaw::by_jerk(2e6)};
  std::ofstream file = table(folder, "short");
  for (const Short when : {Short::lower_top, Short::keep_half, Short::cut_ramp}) {
    law.when_short = when;
    write_profile(file, plan(2500, law), 1e9);
  }
  law.when_short = Short::lower_top;
  law.up = law.down = RampLaw::by_slope(100000);
  law.start_speed_u_s = 2000;
  std::ofstream offsets = table(folder, "offset");
  for (const double offset : {0.0, 60.0, -150.0}) {
    law.slow_down_offset_u = offset;
    write_profile(offsets, plan(3000, law), 1e9);
  }
}

/// A profile, and from `change_s` on another.
void changed(std::ofstream& file, const Profile& first, double change_s,
             const std::function<Profile(Sample)>& second, double until_s) {
  const Profile rest = second(first.sample(change_s));
  for (double t_s = 0; t_s < until_s; t_s += kStep_s) {
    const bool before = t_s < change_s;
    const Sample sample = before ? first.sample(t_s) : rest.sample(t_s - change_s);
    file << t_s << ' ' << sample.position_u << ' ' << sample.speed_u_s << ' ' << sample.acceleration_u_s2
         << " 0\n";
  }
  file << "\n\n";
}

void changes(const std::filesystem::path& folder) {
  const SpeedLaw law{.top_speed_u_s = 20000, .up = RampLaw::by_jerk(2e6), .down = RampLaw::by_jerk(2e6)};
  const Profile move = plan(8000, law);
  SpeedLaw slow = law;
  slow.top_speed_u_s = 8000;
  std::ofstream file = table(folder, "changes");
  changed(
      file, move, 10, [](Sample) { return Profile{}; }, 0.7);
  changed(
      file, move, 0.25, [&](Sample now) { return change_target(now, 8000, slow); }, 0.9);
  changed(
      file, move, 0.25, [&](Sample now) { return change_target(now, 12000, law); }, 0.9);
  changed(
      file, move, 0.25, [&](Sample now) { return change_target(now, 3500, law); }, 0.9);
  changed(
      file, move, 0.25, [&](Sample now) { return slow_to_stop(now, law); }, 0.7);
}

void geometry(const std::filesystem::path& folder) {
  const auto trace = [](std::ofstream& file, const Path& path) {
    for (int i = 0; i <= 300; ++i) {
      const Point here = path.at(path.length_u * i / 300);
      file << here[0] << ' ' << here[1] << ' ' << here[2] << '\n';
    }
    file << "\n\n";
  };
  const Point origin = Point::Zero();
  std::ofstream arcs = table(folder, "arcs");
  const Point end(60, 30, 0, 0);
  for (const double radius : {40.0, -40.0}) {
    for (const Turn turn : {Turn::counter_clockwise, Turn::clockwise})
      trace(arcs, arc_by_radius(origin, end, radius, turn));
  }
  trace(arcs, arc_by_three_points(origin, Point(20, 35, 0, 0), end));
  std::ofstream helix = table(folder, "helix");
  trace(helix, arc_by_sweep(origin, Point(30, 0, 0, 0), 6 * 3.14159265358979, Point(0, 0, 60, 0)));
  std::ofstream coil = table(folder, "spiral");
  trace(coil, spiral(Point(10, 0, 0, 0), origin, 6 * 3.14159265358979, 12));
}

void corners(const std::filesystem::path& folder) {
  // A stair of lines with corners of 30 and 90 degrees, run through, joined below 45 degrees, and stopped
  // between.
  const Point corners[] = {Point(0, 0, 0, 0), Point(60, 0, 0, 0), Point(103.301, 25, 0, 0),
                           Point(78.301, 68.301, 0, 0)};
  std::ofstream file = table(folder, "corners");
  for (const Joint joint :
       {Joint{.rule = Joint::Rule::stop}, Joint{.rule = Joint::Rule::join_below, .corner_deg = 45},
        Joint{.rule = Joint::Rule::join}}) {
    PathRun run;
    run.set_speed({.top_speed_u_s = 100, .up = RampLaw::by_slope(500), .down = RampLaw::by_slope(500)}, 0);
    for (int i = 0; i < 3; ++i) run.append(line(corners[i], corners[i + 1]), joint, 0);
    run.start(-1);
    for (Tick tick = 0; tick < 5000; ++tick) {
      const Point here = run.step(tick);
      if (run.queued() == 0) break;
      if (tick % 4 != 0) continue;
      file << static_cast<double>(tick) / kTicksPerSecond << ' ' << here[0] << ' ' << here[1] << ' '
           << run.sample(tick).speed_u_s << '\n';
    }
    file << "\n\n";
  }
}

}  // namespace

}  // namespace understudy::docs

int main(int count, char** arguments) {
  using namespace understudy::docs;
  if (count != 2) {
    std::fprintf(stderr, "usage: motion_samples FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder);
  families(folder);
  short_moves(folder);
  changes(folder);
  geometry(folder);
  corners(folder);
  write_homing_samples(folder);
}
