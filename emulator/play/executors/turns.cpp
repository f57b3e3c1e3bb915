#include "emulator/play/executors/turns.h"

#include <mutex>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/play/executors/condition_watch.h"

namespace understudy::emulator::play {

void Turns::act(SimTime now) {
  std::unique_lock lock(mutex_);
  if (!end_) return;
  if (*end_ == kForever && watch_ != nullptr) watch_->look();
  const bool is_found = watch_ != nullptr && watch_->is_met();
  if (now < *end_ && !is_found && !is_given_up_) return;
  turn_ = Whose::scenario;
  changed_.notify_all();
  changed_.wait(lock, [this] { return turn_ == Whose::world; });
}

std::optional<SimTime> Turns::next_act() const {
  const std::lock_guard lock(mutex_);
  return end_ == kForever ? std::nullopt : end_;
}

void Turns::give_up() {
  const std::lock_guard lock(mutex_);
  is_given_up_ = true;
}

void Turns::leave() {
  const std::lock_guard lock(mutex_);
  is_given_up_ = is_left_ = true;
  changed_.notify_all();
}

bool Turns::is_given_up() const {
  const std::lock_guard lock(mutex_);
  return is_given_up_;
}

void Turns::wait_for_turn(std::unique_lock<std::mutex>& lock) {
  changed_.wait(lock, [this] { return turn_ == Whose::scenario || is_left_; });
  watch_ = nullptr;
}

void Turns::begin() {
  std::unique_lock lock(mutex_);
  wait_for_turn(lock);
}

void Turns::wait_until(SimTime end, ConditionWatch* watch) {
  std::unique_lock lock(mutex_);
  end_ = end;
  watch_ = watch;
  turn_ = Whose::world;
  changed_.notify_all();
  wait_for_turn(lock);
}

void Turns::finish() {
  const std::lock_guard lock(mutex_);
  end_.reset();
  turn_ = Whose::world;
  changed_.notify_all();
}

}  // namespace understudy::emulator::play
