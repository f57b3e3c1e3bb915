#include "emulator/hunt/found_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/state/state_bytes.h"
#include "base/text/one_line.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/course_player.h"
#include "emulator/hunt/shrinker.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/case.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/bench_file/yaml_text.h"

namespace understudy::emulator::hunt {

namespace {

namespace fs = std::filesystem;

std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

/// Returns the last two names of a field: of "steps[3].program.feeder", "program" and "feeder".
std::pair<std::string_view, std::string_view> last_names(std::string_view field) {
  const std::size_t dot = field.rfind('.');
  if (dot == std::string_view::npos) return {{}, field};
  const std::string_view before = field.substr(0, dot);
  const std::size_t dot_before = before.rfind('.');
  return {before.substr(dot_before == std::string_view::npos ? 0 : dot_before + 1), field.substr(dot + 1)};
}

/// Returns true for a scalar that is a path, relative to the folder of its file.
bool is_path(const world::YamlFields& scalar) {
  const std::string& field = scalar.field();
  const std::string text = scalar.text();
  if (text.empty() || text.find('\n') != std::string::npos) return false;
  if (field == "bench" || field.starts_with("nv.")) return true;
  const auto [before, last] = last_names(field);
  if (field.starts_with("bench.")) {
    if (last == "model") return text.find('/') != std::string::npos || text.ends_with(".yaml");
    return last == "program" || last == "nv" || last == "link";
  }
  return before == "program" || before == "memory";
}

/// Writes nodes for a file in another folder.
class Writer {
 public:
  explicit Writer(const std::string& folder) : folder_(fs::absolute(folder).lexically_normal()) {}

  world::YamlFields moved(const world::YamlFields& node) const {
    return node.settled([this](const world::YamlFields& part) { return text_of(part); });
  }
  std::string step(const world::YamlFields& node) const {
    std::string text;
    std::string lead = "  - ";
    for (const auto& [key, value] : moved(node).entries()) {
      text += world::block_text(key, value, "    ", lead);
      lead = "    ";
    }
    return text;
  }

 private:
  std::optional<std::string> text_of(const world::YamlFields& part) const {
    if (!part.is_scalar()) return std::nullopt;
    std::string text = part.text();
    if (is_path(part) && !fs::path(text).is_absolute()) {
      const fs::path whole = fs::absolute(fs::path(part.folder()) / text).lexically_normal();
      return whole.lexically_relative(folder_).generic_string();
    }
    std::size_t at = 0;
    while ((at = text.find("${", at)) != std::string::npos) {
      text.insert(at, "$");
      at += 3;
    }
    return text;
  }

  fs::path folder_;
};

/// Adds a comment at the end of a step's first line.
std::string with_comment(std::string step, const std::string& comment) {
  constexpr std::size_t kMaxComment = 160;
  std::string text = one_line(comment);
  if (text.size() > kMaxComment) text = text.substr(0, kMaxComment) + "...";
  step.insert(step.find('\n'), "  # " + text);
  return step;
}

/// Returns the spans of the plan that may be the broken one.
std::vector<world::YamlFields> broken_spans(const CoursePlayer& course_player, const play::Failure& failure) {
  std::vector<world::YamlFields> spans;
  for (const world::YamlFields& span : course_player.plan().spans()) {
    const auto [key, value] = span.entries().front();
    const std::string name = value.is_map() && value.has("name") ? value.at("name").text()
                             : value.is_map()                    ? value.at("what").text()
                                                                 : value.text();
    if (failure.what.starts_with(key + " '" + one_line(name) + "'")) spans.push_back(span);
  }
  return spans;
}

std::string heading(const CoursePlayer& course_player, const Shrunk& found, const Origin& origin) {
  const play::ScenarioResult& failed = *found.outcome.failed;
  const std::size_t kept = found.course.disturbances.size();
  std::string text =
      "# Found by `" + one_line(origin.command) + "`, as course " + std::to_string(origin.course) + ".\n";
  text += "# " + one_line(failed.failure->what) + "\n";
  if (kept == 0) {
    text += "# It fails without any disturbance.\n";
  } else {
    text += "# " + counted(kept, "disturbance") + " of " + std::to_string(origin.disturbances) +
            (kept == 1 ? " is enough" : " are enough");
    text += found.is_minimal ? "; without " + std::string(kept == 1 ? "it" : "any one of them") +
                                   " the scenario does not fail in this way.\n"
                             : ".\n";
  }
  if (!origin.again.empty()) text += "# `" + one_line(origin.again) + "` runs it again.\n";
  if (!course_player.scenario().which.values.empty())
    text += "# The case is " + one_line(play::to_text(course_player.scenario().which)) + ".\n";
  return text;
}

constexpr std::string_view kMark = "# The next hunt replaces this file unless it is edited: ";

/// Returns a line with the checksum of all other lines.
std::string marked(const std::string& others) {
  constexpr std::size_t kDigits = 8;
  const std::uint64_t hash = hash_of(std::as_bytes(std::span(others)));
  return std::string(kMark) + play::identity_text(hash).substr(0, kDigits) + "\n";
}

}  // namespace

std::string line_of(const play::HuntPlan& plan, const play::Disturbance& disturbance) {
  std::string line;
  for (const world::YamlFields& fields : plan.steps_of(disturbance)) {
    const std::string step = world::flow_text(fields);
    line += (line.empty() ? "" : "; ") + step.substr(2, step.size() - 4);  // without its braces
  }
  return one_line(line);
}

std::string name_of_finding(const CoursePlayer& course_player, const Shrunk& found) {
  // The kind contains the path of the file, which may be spelled differently.
  std::string what = found.outcome.kind;
  const std::string& file = course_player.scenario().file;
  for (std::size_t at = 0; (at = what.find(file)) != std::string::npos;) what.erase(at, file.size());
  const std::uint64_t hash = hash_of(std::as_bytes(std::span(what)));
  constexpr std::size_t kDigits = 8;
  return fs::path(file).stem().string() + "-" + play::identity_text(hash).substr(0, kDigits);
}

namespace {

std::string text_without_heading(const CoursePlayer& course_player, const Shrunk& found,
                                 const std::string& folder) {
  const Writer writer(folder);
  const play::Failure& failure = *found.outcome.failed->failure;
  std::string text = "understudy: 1\n";
  text += "name: " + name_of_finding(course_player, found) + "\n";
  for (const auto& [key, value] : writer.moved(course_player.plan().head()).entries())
    text += world::block_text(key, value, "", "");
  if (!course_player.scenario().choice.empty()) {
    text += "choice: { " + course_player.scenario().choice + ": [ " +
            course_player.scenario().which.values.front().second + " ] }\n";
  }
  if (course_player.scenario().seed != 0 && !course_player.plan().head().has("seed"))
    text += "seed: " + std::to_string(course_player.scenario().seed) + "\n";
  text += "steps:\n";
  for (const world::YamlFields& span : broken_spans(course_player, failure))
    text += with_comment(writer.step(span), "this is what must hold");
  std::size_t number = 0;
  const std::size_t count = found.course.disturbances.size();
  auto next = found.course.disturbances.begin();
  const auto& steps = course_player.plan().steps();
  for (std::size_t i = 0; i < steps.size() && i < found.course.end; ++i) {
    for (; next != found.course.disturbances.end() && next->step <= i; ++next) {
      std::vector<world::YamlFields> its_steps = course_player.plan().steps_of(*next);
      const world::YamlFields last = std::move(its_steps.back());
      its_steps.pop_back();
      for (const world::YamlFields& step : its_steps) text += writer.step(step);
      text += with_comment(writer.step(last),
                           "disturbance " + std::to_string(++number) + " of " + std::to_string(count));
    }
    if (found.course.left_out.contains(i) || steps[i].continues) continue;
    const std::string step = writer.step(steps[i].fields);
    text += i == found.outcome.failed_step ? with_comment(step, "here: " + failure.what) : step;
  }
  return text;
}

}  // namespace

bool is_edited(const std::string& text) {
  if (text.empty()) return false;
  const std::size_t begin = text.find(kMark);
  const std::size_t end = begin == std::string::npos ? begin : text.find('\n', begin);
  if (end == std::string::npos) return true;
  const std::string rest = text.substr(0, begin) + text.substr(end + 1);
  return text.compare(begin, end + 1 - begin, marked(rest)) != 0;
}

std::string text_of_finding(const CoursePlayer& course_player, const Shrunk& found, const Origin& origin,
                            const std::string& folder) {
  const std::string head = heading(course_player, found, origin);
  const std::string steps = text_without_heading(course_player, found, folder);
  return head + marked(head + steps) + steps;
}

}  // namespace understudy::emulator::hunt
