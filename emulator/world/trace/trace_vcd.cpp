// Writes value change dumps (IEEE 1364), which GTKWave can open.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/trace/trace.h"

namespace understudy::emulator::world {

namespace {

/// Returns an identifier in the format: '!', '"', and so on.
std::string code_of(std::size_t number) {
  constexpr std::size_t kFirst = 33;
  constexpr std::size_t kCount = 94;
  std::string code;
  do {
    code += static_cast<char>(kFirst + number % kCount);
    number /= kCount;
  } while (number > 0);
  return code;
}

std::string binary(std::int64_t value) {
  if (value == 0) return "0";
  std::string text;
  for (auto bits = static_cast<std::uint64_t>(value); bits != 0; bits >>= 1)
    text.insert(0, bits & 1 ? "1" : "0");
  return text;
}

/// Rounds a value that was an integer when the trace began but no longer is.
std::int64_t nearest_whole(Number value) {
  constexpr double kMax = 9e15;
  return value.is_whole() ? value.whole() : std::llround(std::clamp(value.real(), -kMax, kMax));
}

class VcdTrace final : public TraceFormat {
 public:
  explicit VcdTrace(TakeLine take) : take_(std::move(take)) {}

  void begin(const std::vector<TraceSignal>& signals) override {
    signals_ = signals;
    std::string text = "$version Understudy $end\n$timescale 1 ms $end\n";
    std::vector<std::string> scopes;
    for (std::size_t i = 0; i < signals.size(); ++i) {
      std::vector<std::string> path = parts_of(signals[i].name);
      const std::string leaf = path.back();
      path.pop_back();
      enter(scopes, path, text);
      switch (signals[i].kind) {
        case TraceSignal::Kind::whole: text += "$var integer 64 "; break;
        case TraceSignal::Kind::real: text += "$var real 64 "; break;
        case TraceSignal::Kind::bit: text += "$var wire 1 "; break;
      }
      text += code_of(i) + " " + leaf + " $end\n";
    }
    enter(scopes, {}, text);
    take_(text + "$enddefinitions $end\n");
  }

  void row(SimTime at, const std::vector<Number>& values, const std::vector<bool>& is_new) override {
    std::string text = "#" + std::to_string(tick_at(at)) + "\n";
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!is_new[i]) continue;
      switch (signals_[i].kind) {
        case TraceSignal::Kind::whole: text += "b" + binary(nearest_whole(values[i])) + " "; break;
        case TraceSignal::Kind::real: text += "r" + number_text(values[i].real()) + " "; break;
        case TraceSignal::Kind::bit: text += values[i].is_true() ? "1" : "0"; break;
      }
      text += code_of(i) + "\n";
    }
    take_(text);
  }

  void end(SimTime at, const std::vector<Number>&) override {
    take_("#" + std::to_string(tick_at(at)) + "\n");
  }

 private:
  /// Splits "feeder.A.position" at its dots, but does not separate a bit from its register:
  /// "feeder.STATUS.4". Replaces blanks, which are not allowed in names of the format.
  static std::vector<std::string> parts_of(const std::string& name) {
    std::vector<std::string> parts(1);
    for (const char c : name) {
      if (c == '.') {
        parts.emplace_back();
      } else {
        parts.back() += c == ' ' ? '_' : c;
      }
    }
    if (parts.size() > 1 && parts.back().find_first_not_of("0123456789") == std::string::npos) {
      const std::string bit = parts.back();
      parts.pop_back();
      parts.back() += "." + bit;
    }
    return parts;
  }

  /// Leaves the open scopes that are not in `path`, and enters those that are.
  static void enter(std::vector<std::string>& scopes, const std::vector<std::string>& path,
                    std::string& text) {
    std::size_t common = 0;
    while (common < scopes.size() && common < path.size() && scopes[common] == path[common]) ++common;
    for (std::size_t i = scopes.size(); i > common; --i) text += "$upscope $end\n";
    for (std::size_t i = common; i < path.size(); ++i) text += "$scope module " + path[i] + " $end\n";
    scopes = path;
  }

  TakeLine take_;
  std::vector<TraceSignal> signals_;
};

}  // namespace

std::unique_ptr<TraceFormat> vcd_format(TakeLine take) { return std::make_unique<VcdTrace>(std::move(take)); }

}  // namespace understudy::emulator::world
