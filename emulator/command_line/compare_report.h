// Reports the results of `compare` for one capture, for people, programs and CI services.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/command_line/findings.h"

namespace understudy::emulator::command_line {

using VerdictCounts = std::array<std::size_t, box::kVerdictNames.size()>;

/// A reply that differs from the controller's.
struct JudgedReply {
  std::size_t place = 0;
  SimTime at{0};
  box::Judgement judgement{};
};

/// An option that removes the first difference.
struct Remedy {
  std::string text;      // "feeder.exceptions: no_answer"
  std::string section;   // the manual's section; empty: the option is a version of the firmware
  std::string question;  // a question that the manual does not answer
};

class CaptureComparison {
 public:
  explicit CaptureComparison(std::string path) : path_(std::move(path)) {}

  void add(const box::Exchange& exchange, const box::Judgement& judgement);

  bool is_different() const { return first_.has_value(); }
  /// Returns the number of the exchange with the first difference.
  std::size_t first_number() const { return first_number_; }
  const std::optional<JudgedReply>& first() const { return first_; }

  std::string text() const;
  /// Returns the line that `--follow` prints for a reply.
  static std::string line_of(const std::string& path, const JudgedReply& reply);
  nlohmann::ordered_json json() const;
  CheckedFile findings() const;
  /// Returns the sections of the page about this capture.
  std::string page_sections() const;

  box::CaptureNotes notes{};
  std::string first_section{};  // the manual's section about the register of the first difference
  std::vector<Remedy> remedies{};
  bool has_searched = true;     // remedies were searched for
  bool is_interrupted = false;  // only a part was read or searched
  double drift_ppm = 0;
  SimTime usual_delay{0};
  std::set<std::string> taken_inputs{};  // whose levels were taken from replies

 private:
  std::string path_;
  std::size_t exchanges_ = 0;
  VerdictCounts counts_{};
  std::map<std::string, VerdictCounts> by_kind_;  // counts for each kind of request
  std::vector<JudgedReply> not_same_;             // only the first of these replies
  std::size_t left_out_ = 0;
  std::optional<JudgedReply> first_;
  std::size_t first_number_ = 0;
  std::string last_agreement_;  // the request before the first difference
};

/// Returns all comparisons as one HTML page without scripts.
std::string compare_page(const std::vector<CaptureComparison>& comparisons, const std::string& bench,
                         std::string_view version);

}  // namespace understudy::emulator::command_line
