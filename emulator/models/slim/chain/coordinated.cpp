// Commands that involve several modules.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/chain/paths.h"
#include "emulator/models/slim/chain/queues.h"
#include "emulator/models/slim/chain/refusals.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/bad_motion.h"
#include "motion/path.h"

namespace understudy::emulator::models::slim {

Error Chain::assign(Letter letter, int module) {
  if (module != kUnassigned && (module < 0 || module >= kMappable)) return Error::range;
  const auto mine = static_cast<std::size_t>(letter);
  const auto number = module == kUnassigned ? kNoModule : static_cast<std::int8_t>(module);
  for (std::size_t i = 0; i < state_.map.size(); ++i) {
    if (i != mine && number != kNoModule && state_.map[i] == number) return Error::range;
  }
  state_.map[mine] = number;
  return Error::none;
}

int Chain::assigned(Letter letter) const {
  const int module = state_.map[static_cast<std::size_t>(letter)];
  return module < 0 ? kUnassigned : module;
}

namespace {

/// Enqueues a job with the present settings.
Error enqueue_coordinated(ChainState& chain, Job job) {
  motion::Point begin = motion::Point::Zero();
  bool begin_is_known = true;  // during a jog, the beginning is a guess
  const ModuleSettings& first = chain.modules[at(job.module_of[0])].settings;
  for (std::size_t i = 0; i < job.module_of.size(); ++i) {
    const int module = job.module_of[i];
    if (module < 0) continue;
    if (const Error why = refusal_of_motion(chain, module); why != Error::none) return why;
    const Module& mine = chain.modules[at(module)];
    const bool equal =
        path_speed(chain.options, job, mine.settings) == path_speed(chain.options, job, first) &&
        mine.settings.path_acceleration_units_s2 == first.path_acceleration_units_s2;
    if (!equal && !chain.options.speeds_are_of_t0()) return Error::unequal_speeds;
    begin_is_known = begin_is_known && !mine.jogs_or_pushes() && mine.activity != Activity::stopping;
    begin[static_cast<Eigen::Index>(i)] = mine.end_expected(module, chain.axes[at(module)]);
  }
  job.continuous = chain.continuous;
  job.smooth_corner_deg = chain.modules[0].settings.smooth_corner_deg;
  if (chain.options.acceleration_may_change()) {
    job.path_acceleration_units_s2 = path_settings(chain, job).path_acceleration_units_s2;
  }
  try {
    const motion::Path path = path_of(job, begin);
    if (!within_reach(chain, job, path)) return Error::range;
    if (begin_is_known && is_refused_as_empty(chain.options, path)) return Error::range;
    for (std::size_t i = 0; i < job.ends.size(); ++i) job.ends[i] = path.end[static_cast<Eigen::Index>(i)];
  } catch (const motion::BadMotion&) {
    return Error::range;
  }
  return enqueue(chain, job);
}

}  // namespace

Error Chain::line(std::span<const double> units, bool absolute) {
  if (units.size() < 2 || units.size() > state_.map.size()) return Error::range;
  Job job{.kind = Job::Kind::line, .absolute = absolute};
  for (std::size_t i = 0; i < units.size(); ++i) {
    job.module_of[i] = state_.map[i];
    job.units[i] = units[i];
    if (state_.map[i] < 0) return Error::axis;
  }
  return enqueue_coordinated(state_, job);
}

Error Chain::arc(const ArcOrder& order) {
  Job job{.kind = Job::Kind::arc, .absolute = order.absolute, .sweep_deg = order.sweep_deg};
  job.units = {order.centre_x_units, order.centre_y_units, order.height_units.value_or(0), 0};
  if (order.radius_units) {
    job.by_radius = true;
    job.sweep_deg = *order.radius_units;
  }
  job.height_absolute = order.absolute || options().chose(option("sar_height", "absolute"));
  const std::size_t letters = order.height_units ? 3 : 2;
  for (std::size_t i = 0; i < letters; ++i) {
    job.module_of[i] = state_.map[i];
    if (state_.map[i] < 0) return Error::axis;
  }
  return enqueue_coordinated(state_, job);
}

Error Chain::spiral(double centre_x_units, double centre_y_units, double sweep_deg, double growth_units) {
  Job job{.kind = Job::Kind::spiral, .sweep_deg = sweep_deg, .growth_units_turn = growth_units};
  job.absolute = !options().chose(option("spiral_centre", "relative"));
  job.by_radius = options().chose(option("spiral_r", "radius_at_its_end"));
  if (options().chose(option("spiral", "sweep_in_degrees_and_growth_in_all")) && growth_units != 0 &&
      !job.by_radius) {
    // The radius cannot change over a sweep of 0.
    job.growth_units_turn = sweep_deg == 0 ? HUGE_VAL : growth_units * (360 / std::abs(sweep_deg));
    if (!std::isfinite(job.growth_units_turn)) return Error::range;
  }
  job.units = {centre_x_units, centre_y_units, 0, 0};
  for (std::size_t i = 0; i < 2; ++i) {
    job.module_of[i] = state_.map[i];
    if (state_.map[i] < 0) return Error::axis;
  }
  return enqueue_coordinated(state_, job);
}

Error Chain::set_continuous_path(int mode) {
  if (mode < 0 || mode > 2) return Error::range;
  state_.continuous = static_cast<ContinuousPath>(mode);
  return Error::none;
}

}  // namespace understudy::emulator::models::slim
