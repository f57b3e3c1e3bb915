#include "emulator/serve/loop/pacer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

std::optional<Speed> parse_speed(std::string_view text) {
  if (text == "real") return Speed{};
  if (text == "free") return Speed{.kind = Speed::Kind::free};
  if (text == "manual") return Speed{.kind = Speed::Kind::manual};
  if (text.ends_with("x")) text.remove_suffix(1);
  double factor = 0;
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, factor);
  if (error != std::errc{} || parsed != end || !(factor > 0) || factor > 10'000) return std::nullopt;
  return Speed{.factor = factor};
}

double Speed::rate() const {
  switch (kind) {
    case Kind::factor: return factor;
    case Kind::free: return kFreest;
    case Kind::manual: break;
  }
  return 0;
}

std::string format_speed(const Speed& speed) {
  switch (speed.kind) {
    case Speed::Kind::free: return "free";
    case Speed::Kind::manual: return "manual";
    case Speed::Kind::factor: break;
  }
  if (speed.factor == 1.0) return "real";
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), speed.factor);
  return error == std::errc{} ? std::string(text.data(), end) + "x" : "";
}

void Lateness::record(WallTime lateness) {
  recent_[count_ % recent_.size()] = lateness;
  ++count_;
  max_ = std::max(max_, lateness);
}

namespace {

/// Returns the index of a time's bucket. There is one bucket for each value below 16, then sixteen for each
/// power of two.
std::size_t bucket_of(WallTime time) {
  const auto value = static_cast<std::uint64_t>(std::max<std::int64_t>(time.count(), 0));
  if (value < 16) return value;
  const auto power = static_cast<unsigned>(std::bit_width(value)) - 5;
  return std::size_t{power} * 16 + (value >> power);
}

}  // namespace

/// Returns a percentile. The devices wait meanwhile, so only the bucket of the percentile is sorted, not all
/// times.
WallTime Lateness::percentile(int percent) const {
  const std::size_t kept = std::min<std::size_t>(count_, recent_.size());
  if (kept == 0) return WallTime{0};
  const std::size_t rank = std::min(kept - 1, kept * static_cast<std::size_t>(percent) / 100);
  std::array<std::uint16_t, 64 * 16> counts{};
  for (std::size_t i = 0; i < kept; ++i) ++counts[bucket_of(recent_[i])];
  std::size_t bucket = 0;
  std::size_t below = 0;
  while (below + counts[bucket] <= rank) below += counts[bucket++];
  std::vector<WallTime> near;
  near.reserve(counts[bucket]);
  for (std::size_t i = 0; i < kept; ++i) {
    if (bucket_of(recent_[i]) == bucket) near.push_back(recent_[i]);
  }
  const auto place = near.begin() + static_cast<std::ptrdiff_t>(rank - below);
  std::nth_element(near.begin(), place, near.end());
  return *place;
}

SimTime Pacer::target(WallTime wall) const {
  if (standing()) return anchor_sim_;
  const WallTime passed = wall - anchor_wall_;
  if (speed_.rate() == 1.0) return std::min(anchor_sim_ + passed, kHorizon);
  const double ahead_ns = static_cast<double>(passed.count()) * speed_.rate();
  if (ahead_ns >= static_cast<double>((kHorizon - anchor_sim_).count())) return kHorizon;
  return anchor_sim_ + SimTime{std::llround(ahead_ns)};
}

std::optional<WallTime> Pacer::wall_time_of(SimTime time) const {
  if (standing() || time > kHorizon) return std::nullopt;
  const SimTime ahead = time - anchor_sim_;
  if (speed_.rate() == 1.0) return anchor_wall_ + ahead;
  const double wall_ns = std::ceil(static_cast<double>(ahead.count()) / speed_.rate());
  if (wall_ns > 1e18) return WallTime::max() / 2;  // thirty years ahead, beyond the range of the clock
  // Rounded up, because nothing may happen a nanosecond early.
  return anchor_wall_ + WallTime{static_cast<std::int64_t>(wall_ns) + 1};
}

WallTime Pacer::woke(WallTime planned, WallTime wall) {
  const WallTime late = wall - planned;
  if (late < WallTime{0}) return WallTime{0};  // the loop woke up earlier for another reason
  lateness_.record(late);
  if (late <= kLongestStall || standing() || speed_.kind == Speed::Kind::free) return WallTime{0};
  const WallTime left_out = late - kLongestStall;
  anchor_wall_ += left_out;
  ++slips_;
  return left_out;
}

void Pacer::pause(WallTime wall) {
  if (paused_) return;
  moved_to(target(wall), wall);
  paused_ = true;
}

void Pacer::set_speed(const Speed& speed, WallTime wall) {
  moved_to(target(wall), wall);
  speed_ = speed;
}

void Pacer::resume(WallTime wall) {
  if (!paused_) return;
  paused_ = false;
  anchor_wall_ = wall;
}

void Pacer::moved_to(SimTime time, WallTime wall) {
  anchor_sim_ = time;
  anchor_wall_ = wall;
}

}  // namespace understudy::emulator::serve
