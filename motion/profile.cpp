#include "motion/profile.h"

#include <cmath>
#include <cstddef>

#include "motion/bisection.h"

namespace understudy::motion {

Profile Profile::from(double position_u) {
  Profile profile;
  profile.end_position_u = position_u;
  return profile;
}

void Profile::cut_at(double position_u) {
  if (!(end_position_u > position_u)) return;
  const double end_s = endless() ? segments[static_cast<std::size_t>(segment_count - 1)].begin_s : duration_s;
  double cut_s = time_of(*this, position_u, 0, end_s);
  if (endless() && sample(end_s).position_u < position_u) {
    const Segment& last = segments[static_cast<std::size_t>(segment_count - 1)];
    cut_s = last.begin_s + (position_u - last.position_u) / last.speed_u_s;
  }
  while (segment_count > 0 && segments[static_cast<std::size_t>(segment_count - 1)].begin_s >= cut_s) {
    segments[static_cast<std::size_t>(--segment_count)] = Segment{};
  }
  end_speed_u_s = 0;
  if (segment_count > 0) {
    const Segment& last = segments[static_cast<std::size_t>(segment_count - 1)];
    end_speed_u_s = sample_segment(last, cut_s - last.begin_s).speed_u_s;
  }
  duration_s = cut_s;
  end_position_u = position_u;
}

bool Profile::endless() const { return std::isinf(duration_s); }

double time_of(const Profile& profile, double position_u, double from_s, double to_s) {
  const bool upwards = profile.sample(to_s).position_u >= profile.sample(from_s).position_u;
  const auto reached = [&](double t_s) {
    const double here_u = profile.sample(t_s).position_u;
    return upwards ? here_u >= position_u : here_u <= position_u;
  };
  if (reached(from_s)) return from_s;
  return turnover(from_s, to_s, reached).after;
}

}  // namespace understudy::motion
