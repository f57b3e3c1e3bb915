#include "emulator/play/performing/watches.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/expression/expression.h"

namespace understudy::emulator::play {

void SpanWatch::on_tick(Tick) {
  if (violation_) return;
  for (const Span& span : spans_) {
    std::string explained;
    try {
      if (world::is_true(span.condition, values_) != span.is_never) continue;
      explained = world::explain(span.condition, values_);
    } catch (const std::runtime_error& error) {  // no result, which the caller must not notice
      explained = error.what();
    }
    violation_ = {
        .at = world_.now(),
        .what = std::string(span.is_never ? "never" : "always") + " '" + span.name + "' (" + span.place + ")",
        .explained = explained,
        .state = describe_(world_)};
    return;
  }
}

Tick SpanWatch::next_poll(Tick done) const {
  Tick next = kNever;
  for (const Span& span : spans_) next = std::min(next, values_.next_change(span.condition, done));
  return next;
}

bool SpanWatch::close(const std::string& name) {
  return std::erase_if(spans_, [&](const Span& span) { return span.name == name; }) > 0;
}

void ConditionHistory::on_tick(Tick tick) {
  state_.last = tick;
  bool holds = false;
  try {
    holds = world::is_true(condition_, values_);
  } catch (const std::runtime_error&) {  // the step that waits for the condition will report this
  }
  if (holds != (state_.changes.size() % 2 != 0)) state_.changes.push_back(tick);
}

std::optional<Tick> ConditionHistory::first_from(Tick begin) const {
  const std::vector<Tick>& changes = state_.changes;
  for (std::size_t i = 0; i < changes.size(); i += 2) {
    const bool is_last = i + 1 == changes.size();
    const Tick first = std::max(changes[i], begin);
    if (first < (is_last ? state_.last + 1 : changes[i + 1])) return first;
  }
  return std::nullopt;
}

}  // namespace understudy::emulator::play
