#include "motion/counter.h"

#include <cstdint>
#include <optional>

namespace understudy::motion {

namespace {

/// Returns the number of counts before the counter wraps; 0: it never wraps.
std::int64_t size_of(const Counter& counter) {
  switch (counter.range) {
    case Counter::Range::linear: break;
    case Counter::Range::bits32: return std::int64_t{1} << 32;
    case Counter::Range::bits28: return std::int64_t{1} << 28;
    case Counter::Range::ring: return counter.ring_top + 1;
  }
  return 0;
}

std::int64_t wrapped_sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

std::int64_t wrapped_difference(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

std::int64_t modulo(std::int64_t value, std::int64_t size) {
  const std::int64_t rest = value % size;
  return rest < 0 ? rest + size : rest;
}

/// Returns a + b or a - b modulo `size`. Both operands are reduced first, because a ring's size need not
/// divide 2^64.
std::int64_t sum_modulo(std::int64_t a, std::int64_t b, std::int64_t size) {
  const std::int64_t room = size - modulo(b, size);
  const std::int64_t reduced = modulo(a, size);
  return reduced < room ? reduced + (size - room) : reduced - room;
}

std::int64_t difference_modulo(std::int64_t a, std::int64_t b, std::int64_t size) {
  const std::int64_t rest = modulo(a, size) - modulo(b, size);
  return rest < 0 ? rest + size : rest;
}

/// Converts a count of 0 .. size - 1 to a number within the counter's range.
std::int64_t of_range(const Counter& counter, std::int64_t count) {
  const std::int64_t max = *counter.max();
  return count > max ? count - size_of(counter) : count;
}

}  // namespace

std::optional<std::int64_t> Counter::min() const {
  switch (range) {
    case Range::linear: break;
    case Range::bits32:
    case Range::bits28: return -size_of(*this) / 2;
    case Range::ring: return 0;
  }
  return std::nullopt;
}

std::optional<std::int64_t> Counter::max() const {
  if (range == Range::linear) return std::nullopt;
  return *min() + size_of(*this) - 1;
}

std::int64_t Counter::at(std::int64_t travel) const {
  const std::int64_t size = size_of(*this);
  return size == 0 ? wrapped_sum(travel, offset) : of_range(*this, sum_modulo(travel, offset, size));
}

void Counter::set(std::int64_t value, std::int64_t travel) {
  const std::int64_t size = size_of(*this);
  offset = size == 0 ? wrapped_difference(value, travel) : difference_modulo(value, travel, size);
}

std::optional<std::int64_t> Counter::steps_until(std::int64_t value, std::int64_t travel,
                                                 int direction) const {
  const std::int64_t now = at(travel);
  const std::int64_t size = size_of(*this);
  const std::int64_t steps = direction > 0 ? wrapped_difference(value, now) : wrapped_difference(now, value);
  if (size == 0) return steps > 0 ? std::optional(steps) : std::nullopt;
  if (value < *min() || value > *max()) return std::nullopt;
  const std::int64_t round = modulo(steps, size);
  return round == 0 ? size : round;
}

}  // namespace understudy::motion
