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
  std::vector<SimTime> moments;     // at which it did, a few of them
  Sort sort = Sort::order;          // the first sort of what was new
  std::vector<Feature> features{};  // what was new, some of it
};

/// The number of things reached, by sort.
using Counts = std::array<std::size_t, kSorts.size()>;

class Corpus {
 public:
  /// Keeps the course if it reached anything that no course before it did. Returns true if it did. It is not
  /// among the seeds until they are renewed.
  bool add(const Course& course, const Reached& reached);
  /// Makes all courses so far seeds, and weighs them.
  void renew();

  const std::vector<Seed>& seeds() const { return seeds_; }
  /// Draws the number of a seed, of which there must be one: each sort as often as another, since new orders
  /// are so common that they would hide the rest; and of a sort, a seed whose features few courses have
  /// reached more often than others.
  std::size_t draw_seed(Dice& dice) const;
  const Counts& counts() const { return counts_; }

 private:
  /// The seeds of a sort.
  struct Weighed {
    std::vector<std::size_t> numbers;
    std::vector<std::uint64_t> sums;  // of the weights up to each
  };

  std::unordered_map<Feature, std::uint64_t> hits_;  // how many courses have reached each
  std::vector<Seed> seeds_;
  std::array<Weighed, kSorts.size()> by_sort_;
  std::vector<Seed> coming_;
  Counts counts_{};
};

/// A line of a corpus file: a course, or how far a hunt has come.
struct CorpusLine {
  std::optional<Course> course{};
  std::uint64_t seed = 0;
  std::uint64_t next = 0;  // the number of the hunt's next course
};
std::string json_text(const Course& course);
std::string json_text(std::uint64_t seed, std::uint64_t next);
/// Reads a line. Returns nothing if it is not one.
std::optional<CorpusLine> parse_corpus_line(std::string_view line);

}  // namespace understudy::emulator::hunt
