#include "motion/axis.h"

namespace understudy::motion {

void Axis::start(const Profile& move, int move_direction, Tick first_tick) {
  stop();
  if (move.distance_pulses == 0) return;
  drive = Drive::position;
  direction = move_direction < 0 ? std::int8_t{-1} : std::int8_t{+1};
  start_tick = first_tick;
  profile = move;
}

void Axis::hang(int move_direction) {
  stop();
  drive = Drive::hanging;
  direction = move_direction < 0 ? std::int8_t{-1} : std::int8_t{+1};
}

void Axis::stop() {
  drive = Drive::idle;
  sent_pulses = 0;
  profile = Profile{};
}

std::int64_t Axis::step(Tick tick) {
  if (drive != Drive::position) return 0;
  const std::int64_t total = profile.pulses_at(tick - start_tick);
  const std::int64_t now = (total - sent_pulses) * direction;
  sent_pulses = total;
  if (total == profile.distance_pulses && tick - start_tick >= profile.end_tick()) stop();
  return now;
}

Tick Axis::next_active_tick(Tick done) const { return drive == Drive::position ? done + 1 : kNever; }

}  // namespace understudy::motion
