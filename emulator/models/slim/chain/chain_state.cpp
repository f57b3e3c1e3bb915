#include "emulator/models/slim/chain/chain_state.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/errors.h"

namespace understudy::emulator::models::slim {

namespace {

/// Returns the group that uses `module`, or null.
auto* taking(auto& groups, std::size_t module) {
  const auto found = std::find_if(groups.begin(), groups.end(),
                                  [&](const auto& group) { return group.motion.takes(module); });
  return found == groups.end() ? nullptr : &*found;
}

}  // namespace

Group* ChainState::group_of(int module) { return taking(groups, at(module)); }
const Group* ChainState::group_of(int module) const { return taking(groups, at(module)); }

bool ChainState::in_pause_scope(const Group& group) const {
  return std::any_of(group.motion.axis_of.begin(), group.motion.axis_of.end(),
                     [&](std::int8_t member) { return member >= 0 && in_pause_scope(int{member}); });
}

void drop_job(ChainState& chain, std::uint64_t number) {
  for (Module& each : chain.modules) {
    each.fifo.erase_if([&](const Job& job) { return job.number == number; });
  }
}

void drop_head(ChainState& chain, int module, Error why) {
  Module& mine = chain.modules[at(module)];
  mine.late_error = why;
  drop_job(chain, mine.fifo[0].number);
}

void forget_queue(ChainState& chain, int module, std::size_t kept) {
  const auto& fifo = chain.modules[at(module)].fifo;
  while (fifo.size() > kept) drop_job(chain, fifo[kept].number);
}

}  // namespace understudy::emulator::models::slim
