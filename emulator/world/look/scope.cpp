#include "emulator/world/look/scope.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

Scope::Scope(World& world, ScopeSetup setup) : world_(world), setup_(std::move(setup)), probes_(world) {
  for (const std::string& name : setup_.names) handles_.push_back(probes_.resolve(name).handle);
  if (!setup_.condition.empty()) condition_ = parse_expression(setup_.condition, probes_);
  for (const std::int32_t handle : handles_) {
    static_cast<void>(probes_.value(handle));  // throws for a name that only scenarios have
  }
  rows_ = static_cast<std::size_t>(setup_.before + setup_.after + 1);
  ring_.resize(rows_ * handles_.size());
  present_.resize(handles_.size());
  next_tick_ = tick_at(world_.now()) + 1;
  world_.add_watcher(*this);
}

Scope::~Scope() { end(); }

void Scope::end() {
  if (std::exchange(is_watching_, false)) world_.remove_watcher(*this);
}

void Scope::restart() {
  if (!is_watching_) return;
  state_ = State::armed;
  count_ = 0;
  next_tick_ = tick_at(world_.now()) + 1;
}

double Scope::sample(std::size_t name, std::size_t place) const {
  const auto row = (static_cast<std::size_t>(next_tick_) + rows_ - count_ % rows_ + place) % rows_;
  return ring_[row * handles_.size() + name];
}

void Scope::push(Tick tick) {
  const auto row = static_cast<std::size_t>(tick) % rows_;
  std::copy(present_.begin(), present_.end(),
            ring_.begin() + static_cast<std::ptrdiff_t>(row * handles_.size()));
  next_tick_ = tick + 1;
  const auto max =
      static_cast<std::size_t>(state_ == State::armed ? setup_.before + 1 : setup_.before + setup_.after + 1);
  count_ = std::min(count_ + 1, max);
  if (state_ == State::triggered && tick >= trigger_tick_ + setup_.after) {
    state_ = State::done;
    end();
  }
}

/// Returns true if the condition is true. A condition without a result also triggers, with a diagnostic.
bool Scope::is_met() {
  if (condition_.code.empty()) return true;
  try {
    return is_true(condition_, probes_);
  } catch (const std::runtime_error& error) {
    diagnostic_ = error.what();
    return true;
  }
}

void Scope::on_tick(Tick tick) {
  for (std::size_t i = 0; i < handles_.size(); ++i) present_[i] = probes_.value(handles_[i]).real();
  if (state_ == State::armed && is_met()) {
    state_ = State::triggered;
    trigger_tick_ = tick;
  }
  push(tick);
}

Tick Scope::next_poll(Tick done) const {
  Tick next = probes_.next_change(condition_, done);
  for (const std::int32_t handle : handles_) next = std::min(next, probes_.next_change(handle, done));
  return next;
}

/// Handles ticks in which nothing changed. While the scope is armed, only as many ticks count as fit in the
/// ring.
void Scope::on_rest(Tick last) {
  const Tick first = std::max(next_tick_, last - static_cast<Tick>(rows_) + 1);
  if (state_ == State::armed && first > next_tick_) count_ = 0;
  for (Tick tick = state_ == State::armed ? first : next_tick_; tick <= last && state_ != State::done; ++tick)
    push(tick);
}

}  // namespace understudy::emulator::world
