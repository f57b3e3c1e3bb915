// The courses of a hunt that reached something new. Later courses start from them. A file keeps them for the
// next hunt.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/reach.h"

namespace understudy::emulator::hunt {

/// A course that reached something new.
struct Seed {
  Course course;
  std::vector<SimTime> moments;  // when it did; at most a few
  Sort sort = Sort::order;       // the first sort in which something was new
};

/// The number of things reached, by sort.
using Counts = std::array<std::size_t, kSorts.size()>;

class Corpus {
 public:
  /// Keeps the course if it reached anything that no course before it did. Returns true if it did. It is not
  /// among the seeds until they are renewed.
  bool add(const Course& course, const Reached& reached);
  /// Makes all courses so far seeds.
  void renew();

  const std::vector<Seed>& seeds() const { return seeds_; }
  /// Returns the numbers of the seeds of a sort. New orders are so common that they would hide the rest.
  const std::vector<std::size_t>& seeds_of(Sort sort) const {
    return by_sort_[static_cast<std::size_t>(sort)];
  }
  const Counts& counts() const { return counts_; }

 private:
  std::unordered_set<Feature> reached_;
  std::vector<Seed> seeds_;
  std::array<std::vector<std::size_t>, kSorts.size()> by_sort_;
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
