#include "emulator/hunt/corpus.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/reach.h"
#include "emulator/play/reading/hunt_plan.h"

namespace understudy::emulator::hunt {

namespace {

using Json = nlohmann::json;
using When = play::Disturbance::When;

constexpr std::size_t kMaxMoments = 16;   // for each seed
constexpr std::size_t kMaxFeatures = 16;  // for each seed
constexpr std::size_t kMaxRead = 64;      // disturbances of a course in a file
constexpr std::array<std::string_view, 4> kWhen{"here", "at", "nth", "late"};

template <typename Number>
bool read(const Json& object, const char* key, Number& number) {
  const auto it = object.find(key);
  if (it == object.end() || !it->is_number_unsigned()) return false;
  const auto value = it->get<std::uint64_t>();
  if (value > static_cast<std::uint64_t>(INT64_MAX)) return false;
  number = static_cast<Number>(value);
  return true;
}

std::optional<play::Disturbance> parse_disturbance(const Json& object) {
  play::Disturbance one{.values = {}};
  if (!object.is_object() || !read(object, "entry", one.entry) || !read(object, "step", one.step))
    return std::nullopt;
  const auto when = object.find("when");
  const auto values = object.find("values");
  if (when == object.end() || !when->is_string() || values == object.end() || !values->is_array() ||
      !read(object, "moment", one.moment))
    return std::nullopt;
  const auto word = std::find(kWhen.begin(), kWhen.end(), when->get_ref<const std::string&>());
  if (word == kWhen.end()) return std::nullopt;
  one.when = static_cast<When>(word - kWhen.begin());
  for (const Json& value : *values) {
    if (!value.is_number_unsigned()) return std::nullopt;
    one.values.push_back(value.get<std::uint64_t>());
  }
  return one;
}

}  // namespace

bool Corpus::add(const Course& course, const Reached& reached) {
  std::vector<SimTime> moments;
  std::vector<Feature> features;
  bool is_new = false;
  Sort sort = Sort::order;
  for (const auto& [feature, when] : reached.when) {
    if (++hits_[feature] > 1) continue;
    is_new = true;
    features.push_back(feature);
    sort = std::min(sort, sort_of(feature));
    ++counts_[static_cast<std::size_t>(sort_of(feature))];
    moments.push_back(when);
  }
  if (!is_new) return false;
  // The order in which features are iterated must not matter.
  std::sort(features.begin(), features.end());
  if (features.size() > kMaxFeatures) features.resize(kMaxFeatures);
  std::sort(moments.begin(), moments.end());
  moments.erase(std::unique(moments.begin(), moments.end()), moments.end());
  if (moments.size() > kMaxMoments) {
    std::vector<SimTime> few;
    for (std::size_t i = 0; i < kMaxMoments; ++i) few.push_back(moments[i * moments.size() / kMaxMoments]);
    moments = std::move(few);
  }
  coming_.push_back(
      {.course = course, .moments = std::move(moments), .sort = sort, .features = std::move(features)});
  return true;
}

void Corpus::renew() {
  for (Seed& seed : coming_) {
    by_sort_[static_cast<std::size_t>(seed.sort)].numbers.push_back(seeds_.size());
    seeds_.push_back(std::move(seed));
  }
  coming_.clear();
  for (Weighed& weighed : by_sort_) {
    weighed.sums.clear();
    std::uint64_t sum = 0;
    for (const std::size_t number : weighed.numbers) {
      std::uint64_t rarest = UINT64_MAX;
      for (const Feature feature : seeds_[number].features) rarest = std::min(rarest, hits_.at(feature));
      constexpr std::uint64_t kFull = 1 << 16;  // the weight of what only one course has reached
      weighed.sums.push_back(sum += std::max<std::uint64_t>(1, kFull / rarest));
    }
  }
}

std::size_t Corpus::draw_seed(Dice& dice) const {
  std::vector<const Weighed*> sorts;
  for (const Weighed& weighed : by_sort_) {
    if (!weighed.numbers.empty()) sorts.push_back(&weighed);
  }
  const Weighed& weighed = *sorts[dice.below(sorts.size())];
  const auto drawn =
      std::upper_bound(weighed.sums.begin(), weighed.sums.end(), dice.below(weighed.sums.back()));
  return weighed.numbers[static_cast<std::size_t>(drawn - weighed.sums.begin())];
}

std::string json_text(const Course& course) {
  Json all = Json::array();
  for (const play::Disturbance& one : course.disturbances) {
    all.push_back({{"entry", one.entry},
                   {"step", one.step},
                   {"when", kWhen[static_cast<std::size_t>(one.when)]},
                   {"moment", static_cast<std::uint64_t>(one.moment)},
                   {"values", one.values}});
  }
  return Json{{"case", course.case_number}, {"disturbances", all}}.dump();
}

std::string json_text(std::uint64_t seed, std::uint64_t next) {
  return Json{{"seed", seed}, {"next", next}}.dump();
}

std::optional<CorpusLine> parse_corpus_line(std::string_view line) {
  const Json object = Json::parse(line, nullptr, false);
  if (!object.is_object()) return std::nullopt;
  CorpusLine read_line;
  if (object.contains("next")) {
    if (!read(object, "next", read_line.next) || !read(object, "seed", read_line.seed)) return std::nullopt;
    return read_line;
  }
  Course course;
  const auto all = object.find("disturbances");
  if (!read(object, "case", course.case_number) || all == object.end() || !all->is_array() ||
      all->size() > kMaxRead)
    return std::nullopt;
  for (const Json& element : *all) {
    auto one = parse_disturbance(element);
    if (!one) return std::nullopt;
    course.disturbances.push_back(*std::move(one));
  }
  read_line.course = std::move(course);
  return read_line;
}

}  // namespace understudy::emulator::hunt
