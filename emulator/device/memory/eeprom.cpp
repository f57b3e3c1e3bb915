#include "emulator/device/memory/eeprom.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/state_error.h"

namespace understudy::emulator {

Eeprom::Eeprom(std::span<const std::uint32_t> factory, std::span<const bool> is_persistent,
               std::span<const bool> at_once)
    : content_(factory.begin(), factory.end()) {
  for (std::size_t slot = 0; slot < is_persistent.size(); ++slot) {
    const bool needs_no_time = !at_once.empty() && at_once[slot];
    slots_.push_back(!is_persistent[slot] ? Slot::not_persistent
                     : needs_no_time      ? Slot::at_once
                                          : Slot::rests);
  }
}

void Eeprom::begin(Tick at, std::uint32_t bits) {
  done_at_ = jobs_.empty() ? kNever : at + jobs_.front().takes;
  writing_ = bits;
  if (!jobs_.empty() && jobs_.front().slot != kEverything) slots_[jobs_.front().slot] = Slot::rests;
}

void Eeprom::keep(std::size_t slot, std::uint32_t bits) {
  if (content_[slot] == bits) return;
  content_[slot] = bits;
  ++revision_;
}

void Eeprom::write(std::size_t slot, std::uint32_t bits, Tick takes, Tick now, bool even_if_same) {
  if (slots_[slot] == Slot::at_once) return keep(slot, bits);
  if (slots_[slot] != Slot::rests) return;
  const bool is_being_written = !jobs_.empty() && jobs_.front().slot == slot;
  if (is_being_written && now < done_at_ - jobs_.front().takes) {  // the write has not begun yet
    writing_ = bits;
    return;
  }
  const std::vector<std::uint32_t>& stored = rewriting_.empty() ? content_ : rewriting_;
  const std::uint32_t before = is_being_written ? writing_ : stored[slot];
  if (before == bits && !even_if_same) return;
  slots_[slot] = Slot::waits;
  jobs_.push_back({static_cast<std::uint32_t>(slot), takes});
  // The first job begins with the next tick.
  if (jobs_.size() == 1) begin(now + 1, bits);
}

void Eeprom::rewrite(std::span<const std::uint32_t> image, Tick takes, Tick now) {
  forget_jobs();
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    if (slots_[slot] == Slot::at_once) keep(slot, image[slot]);
  }
  rewriting_.assign(image.begin(), image.end());
  jobs_.push_back({kEverything, takes});
  begin(now + 1, 0);
}

void Eeprom::step(Tick tick, std::span<const std::uint32_t> image) {
  while (done_at_ <= tick) {
    const Job done = jobs_.front();
    jobs_.erase(jobs_.begin());
    if (done.slot == kEverything) {
      // Values written since the rewrite began are not stored here, because they are still waiting and can be
      // lost.
      keep_all(rewriting_, false);
      rewriting_.clear();
    } else {
      keep(done.slot, writing_);
    }
    const bool is_word = !jobs_.empty() && jobs_.front().slot != kEverything;
    begin(done_at_, is_word ? image[jobs_.front().slot] : 0);
  }
}

void Eeprom::keep_all(std::span<const std::uint32_t> image, bool even_at_once) {
  for (std::size_t slot = 0; slot < content_.size(); ++slot) {
    const bool is_left =
        slots_[slot] == Slot::not_persistent || (slots_[slot] == Slot::at_once && !even_at_once);
    if (!is_left) keep(slot, image[slot]);
  }
}

void Eeprom::settle(std::span<const std::uint32_t> image) {
  forget_jobs();
  keep_all(image, true);
}

void Eeprom::forget_jobs() {
  for (const Job& job : jobs_) {
    if (job.slot != kEverything) slots_[job.slot] = Slot::rests;
  }
  jobs_.clear();
  rewriting_.clear();
  done_at_ = kNever;
  writing_ = 0;
}

void Eeprom::lose_power() { forget_jobs(); }

void Eeprom::check_restored(const Eeprom& earlier) const {
  constexpr Tick kLongestJob = 1'000'000;
  const auto is_alike = [](Slot a, Slot b) {
    const auto lasts = [](Slot slot) { return slot == Slot::not_persistent || slot == Slot::at_once; };
    return a == b || (!lasts(a) && !lasts(b));
  };
  require_state(
      content_.size() == earlier.content_.size() && std::ranges::equal(slots_, earlier.slots_, is_alike),
      "it holds different registers");
  // A waiting register has exactly one job that has not begun. A job that writes everything precedes all
  // other jobs.
  std::vector<Slot> left = slots_;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    const Job& job = jobs_[i];
    require_within(job.takes, 0, kLongestJob);
    if (job.slot == kEverything) {
      require_state(i == 0 && rewriting_.size() == content_.size(),
                    "the memory cannot be rewriting its whole content");
    } else {
      // The first job is in progress, so its register is either at rest or waiting for its next value.
      const bool is_expected = job.slot < left.size() &&
                               (left[job.slot] == Slot::waits || (i == 0 && left[job.slot] == Slot::rests));
      require_state(is_expected, "the memory's writes are out of order");
      if (i > 0) left[job.slot] = Slot::rests;
    }
  }
  require_state(std::find(left.begin(), left.end(), Slot::waits) == left.end(),
                "the memory's writes are out of order");
  const bool rewrites = !jobs_.empty() && jobs_.front().slot == kEverything;
  require_state(rewrites || rewriting_.empty(), "the memory cannot be rewriting its whole content");
  require_state(jobs_.empty() == (done_at_ == kNever), "the memory would never finish writing");
  if (done_at_ != kNever) require_reach(done_at_);
}

void Eeprom::put(std::size_t slot, std::uint32_t bits) { keep(slot, bits); }

}  // namespace understudy::emulator
