#include "emulator/play/reading/variation.h"

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/state/state_bytes.h"
#include "base/text/one_line.h"
#include "emulator/play/reading/amounts.h"
#include "emulator/play/reading/scenario_schema.h"
#include "emulator/world/bench_file/bench_schema.h"
#include "emulator/world/bench_file/schema.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

namespace {

/// Returns the result of SplitMix64's final step, in which every bit of the argument changes about half of
/// the bits of the result.
constexpr std::uint64_t stirred(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

Amount amount_in(const world::YamlFields& field) {
  const auto amount = parse_amount(field.text());
  if (!amount) {
    field.fail(quoted(field.text()) +
               " is not an amount; expected a number, a duration or a voltage, such as 12, "
               "0.5, 20ms or 2.5V");
  }
  return *amount;
}

/// Returns the keys that are allowed in an entry, which depend on its kind.
const std::span<const world::Key> keys_of(const world::YamlFields& field) {
  if (field.has("from")) return kRangeKeys;
  if (field.has("between")) return kBetweenKeys;
  if (field.has("one_of")) return kOneOfKeys;
  field.fail("has no values; expected `from`, `between` or `one_of`, as in `{ from: 1, to: 9, step: 2 }`");
}

}  // namespace

std::uint64_t shuffled(std::uint64_t number, std::uint64_t count, std::uint64_t seed) {
  // A Feistel network permutes the numbers with an even number of bits. Results that are too large are
  // permuted again.
  constexpr int kRounds = 6;
  if (count < 2) return 0;
  const int half = (std::bit_width(count - 1) + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  do {
    std::uint64_t left = number >> half;
    std::uint64_t right = number & mask;
    for (std::uint64_t round = 0; round < kRounds; ++round) {
      left = std::exchange(right, left ^ (stirred(right ^ stirred(seed + round)) & mask));
    }
    number = left << half | right;
  } while (number >= count);
  return number;
}

Variation::Variation(const world::YamlFields& field, std::string name, std::uint64_t seed, bool overrides)
    : name_(std::move(name)), field_(field) {
  if (field_.is_list()) {
    read_list(field_);
    count_ = places_ = listed_.size();
    return;
  }
  if (!field_.is_map()) {
    field_.fail(
        "expected values, as in `[ 1, 2 ]`, `{ from: 1, to: 9, step: 2 }` or "
        "`{ between: [ 1, 9 ], samples: 5 }`");
  }
  field_.require_keys(keys_of(field_));
  if (field_.has("from")) {
    read_range(false);
    count_ = places_;
    return;
  }
  if (field_.has("between")) {
    read_range(true);
  } else {
    read_list(field_.at("one_of"));
    places_ = listed_.size();
  }
  read_samples(seed, overrides);
}

void Variation::read_list(const world::YamlFields& list) {
  std::set<std::string> seen;
  for (const world::YamlFields& value : list.elements()) {
    if (!value.is_scalar()) value.fail("expected a value, such as 100, 20ms or on");
    listed_.push_back(value.text());
    if (!seen.insert(listed_.back()).second)
      value.fail(quoted(listed_.back()) + " appears twice; expected each value once");
  }
  if (listed_.empty()) list.fail("is empty; expected at least one value");
}

/// Reads `from`, `to` and `step`, or the ends of `between`, which can also have a step.
void Variation::read_range(bool is_drawn) {
  world::YamlFields low = field_;
  world::YamlFields high = field_;
  if (is_drawn) {
    const world::YamlFields ends = field_.at("between");
    const auto both = ends.elements();
    if (both.size() != 2) ends.fail("expected two values, as in `[ 1, 9 ]`");
    low = both[0];
    high = both[1];
  } else {
    low = field_.at("from");
    high = field_.at("to");
  }
  std::vector<std::pair<world::YamlFields, Amount>> all{{low, amount_in(low)}, {high, amount_in(high)}};
  if (!is_drawn || field_.has("step")) all.emplace_back(field_.at("step"), amount_in(field_.at("step")));
  scale_ = AmountScale(all.front().second.kind);
  for (const auto& [where, amount] : all) {
    if (amount.kind != scale_.kind()) {
      where.fail("is " + std::string(kind_name(amount.kind)) + "; expected " +
                 std::string(kind_name(scale_.kind())) + " as " + low.text() + " is");
    }
    scale_.include(amount);
  }
  std::vector<std::int64_t> counts;
  for (const auto& [where, amount] : all) {
    const auto count = scale_.count_of(amount);
    if (!count)
      where.fail(quoted(where.text()) + " is too large or too fine; expected a value that can be counted");
    counts.push_back(*count);
  }
  first_ = counts[0];
  step_ = counts.size() > 2 ? counts[2] : scale_.finest();
  if (scale_.kind() == Amount::Kind::duration && first_ < 0) low.fail("is negative; expected a duration");
  if (step_ <= 0) all[2].first.fail("is " + all[2].first.text() + "; expected more than 0");
  if (counts[1] < first_)
    high.fail(high.text() + " is less than " + low.text() + "; expected the larger value second");
  places_ = static_cast<std::uint64_t>((counts[1] - first_) / step_) + 1;
}

void Variation::read_samples(std::uint64_t seed, bool overrides) {
  is_drawn_ = true;
  if (field_.has("seed")) {
    const auto own = static_cast<std::uint64_t>(field_.at("seed").integer(world::kSeedSchema));
    if (!overrides) seed = own;
  }
  seed_ = stirred(seed ^ hash_of(std::as_bytes(std::span(name_))));
  if (!field_.has("samples")) {
    is_free_ = true;
    count_ = 1;
    return;
  }
  const world::YamlFields samples = field_.at("samples");
  count_ = static_cast<std::uint64_t>(samples.integer(kSamplesSchema));
  if (count_ > places_) {
    samples.fail("the range has only " + std::to_string(places_) + " values; expected at most that many");
  }
}

std::string Variation::value(std::uint64_t number) const {
  return value_at(is_drawn_ ? shuffled(number, places_, seed_) : number);
}

std::string Variation::drawn_for(std::uint64_t hash) const {
  // The upper half of the product is distributed evenly over all places.
  __extension__ using Wide = unsigned __int128;
  return value_at(static_cast<std::uint64_t>(static_cast<Wide>(stirred(hash ^ seed_)) * places_ >> 64));
}

std::string Variation::value_at(std::uint64_t place) const {
  if (!listed_.empty()) return listed_[place];
  return scale_.text_of(first_ + static_cast<std::int64_t>(place) * step_);
}

}  // namespace understudy::emulator::play
