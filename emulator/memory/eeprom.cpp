#include "emulator/memory/eeprom.h"

namespace understudy::emulator {

Eeprom::Eeprom(std::span<const std::uint32_t> factory, std::span<const bool> is_kept)
    : kept_(factory.begin(), factory.end()) {
  for (const bool kept : is_kept) slots_.push_back(kept ? Slot::rests : Slot::not_kept);
}

void Eeprom::begin(Tick at) { done_at_ = jobs_.empty() ? kNever : at + jobs_.front().takes; }

void Eeprom::keep(std::size_t slot, std::uint32_t bits) {
  if (kept_[slot] == bits) return;
  kept_[slot] = bits;
  ++revision_;
}

void Eeprom::write(std::size_t slot, std::uint32_t bits, Tick takes, Tick now) {
  if (slots_[slot] != Slot::rests || kept_[slot] == bits) return;
  slots_[slot] = Slot::waits;
  jobs_.push_back({static_cast<std::uint32_t>(slot), takes});
  // The first of them begins with the next tick.
  if (jobs_.size() == 1) begin(now + 1);
}

void Eeprom::rewrite(Tick takes, Tick now) {
  forget_jobs();
  jobs_.push_back({kEverything, takes});
  begin(now + 1);
}

void Eeprom::step(Tick tick, std::span<const std::uint32_t> image) {
  while (done_at_ <= tick) {
    const Job done = jobs_.front();
    jobs_.erase(jobs_.begin());
    if (done.slot == kEverything) {
      keep_all(image);
    } else {
      slots_[done.slot] = Slot::rests;
      keep(done.slot, image[done.slot]);
    }
    begin(done_at_);
  }
}

/// What was written since waits behind it.
void Eeprom::keep_all(std::span<const std::uint32_t> image) {
  for (std::size_t slot = 0; slot < kept_.size(); ++slot) {
    if (slots_[slot] == Slot::rests) keep(slot, image[slot]);
  }
}

void Eeprom::settle(std::span<const std::uint32_t> image) {
  forget_jobs();
  keep_all(image);
}

void Eeprom::forget_jobs() {
  for (const Job& job : jobs_) {
    if (job.slot != kEverything) slots_[job.slot] = Slot::rests;
  }
  jobs_.clear();
  done_at_ = kNever;
}

void Eeprom::lose_power() { forget_jobs(); }

void Eeprom::put(std::size_t slot, std::uint32_t bits) { keep(slot, bits); }

}  // namespace understudy::emulator
