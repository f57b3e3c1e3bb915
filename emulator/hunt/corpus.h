// The courses of a hunt that reached something new. Later courses start from them. A file keeps them for the
// next hunt.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/reach.h"

namespace understudy::emulator::hunt {

/// A course that reached something new.
struct Seed {
  Course course;
  std::vector<SimTime> moments;     // when it reached something new; only some of the moments
  Sort sort = Sort::order;          // the first sort among its new features
  std::vector<Feature> features{};  // some of its new features
};

/// The number of things reached, by sort.
using Counts = std::array<std::size_t, kSorts.size()>;

class Corpus {
 public:
  /// Keeps the course if it reached anything that no earlier course has reached. Returns true if it did. The
  /// course becomes a seed only with the next renew().
  bool add(const Course& course, const Reached& reached);
  /// Turns all courses so far into seeds, and computes their weights.
  void renew();

  const std::vector<Seed>& seeds() const { return seeds_; }
  /// Draws the number of a seed; there must be at least one. All sorts are equally likely, because new orders
  /// are so common that they would hide the rest. Within a sort, a seed is more likely if few courses have
  /// reached its features.
  std::size_t draw_seed(Dice& dice) const;
  const Counts& counts() const { return counts_; }

 private:
  /// The seeds of a sort.
  struct Weighed {
    std::vector<std::size_t> numbers;
    std::vector<std::uint64_t> sums;  // for each seed, the sum of the weights up to it
  };

  std::unordered_map<Feature, std::uint64_t> hits_;  // how many courses have reached each feature
  std::vector<Seed> seeds_;
  std::array<Weighed, kSorts.size()> by_sort_;
  std::vector<Seed> coming_;
  Counts counts_{};
};

/// A line of a corpus file: a course, or the progress of a hunt.
struct CorpusLine {
  std::optional<Course> course{};
  std::uint64_t seed = 0;
  std::uint64_t next = 0;  // the number of the hunt's next course
};
std::string json_text(const Course& course);
std::string json_text(std::uint64_t seed, std::uint64_t next);
/// Reads a line. Returns nothing if it is not a line of a corpus.
std::optional<CorpusLine> parse_corpus_line(std::string_view line);

}  // namespace understudy::emulator::hunt
