#include "emulator/scenario/watches.h"

#include <algorithm>

namespace understudy::emulator {

void SpanWatch::on_tick(Tick) {
  if (violation_) return;
  for (const Span& span : spans_) {
    std::string explained;
    try {
      if (is_true(span.condition, values_) != span.is_never) continue;
      explained = explain(span.condition, values_);
    } catch (const std::runtime_error& error) {  // no result; whoever runs the world need not know
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

bool SpanWatch::close(const std::string& name) {
  return std::erase_if(spans_, [&](const Span& span) { return span.name == name; }) > 0;
}

void ConditionHistory::on_tick(Tick tick) {
  last_ = tick;
  bool holds = false;
  try {
    holds = is_true(condition_, values_);
  } catch (const std::runtime_error&) {  // whoever waits for it will be told
  }
  if (holds != (changes_.size() % 2 != 0)) changes_.push_back(tick);
}

std::optional<Tick> ConditionHistory::first_from(Tick begin) const {
  for (std::size_t i = 0; i < changes_.size(); i += 2) {
    const bool is_last = i + 1 == changes_.size();
    const Tick first = std::max(changes_[i], begin);
    if (first < (is_last ? last_ + 1 : changes_[i + 1])) return first;
  }
  return std::nullopt;
}

}  // namespace understudy::emulator
