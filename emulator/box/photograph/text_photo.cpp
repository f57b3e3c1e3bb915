// Photographs a controller that speaks text, by its queries.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "emulator/box/asking/text_asker.h"
#include "emulator/box/photograph/photo_parts.h"
#include "emulator/box/photograph/photograph.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

namespace {

constexpr int kModules = 8;
constexpr int kVariables = 65;
constexpr int kArray = 2001;
constexpr WallTime kPause = std::chrono::milliseconds(8);
constexpr WallTime kPauseInList = std::chrono::milliseconds(300);
constexpr std::string_view kRefused = "ERR";

/// Queries for values that are not persistent. Errors come first, because a refused query becomes one.
constexpr std::string_view kOfChain[] = {"ERR", "ERC", "VER", "ST", "IN", "AIN", "TM"};
constexpr std::string_view kOfModule[] = {"PE", "MD", "MT", "AC", "IMX", "IC", "FLE", "TEMP"};
constexpr std::string_view kLinkedModules = "PN50";  // a bit for each

class TextPhoto {
 public:
  explicit TextPhoto(PhotoWork& work) : work_(work) {}

  void take() {
    find_line();
    for (const std::string_view name : kOfChain) ask(std::string(name));
    const unsigned linked = linked_modules();
    make_factory();
    for (int module = 0; module < kModules; ++module)
      if ((linked >> module & 1) != 0) take_module(module);
    take_variables("N", "", kVariables);
    take_variables("R", "", kVariables);
    if (work_.settings.has_arrays) {
      take_variables("NS(", ")", kArray);
      take_variables("RS(", ")", kArray);
    }
    take_program();
    settle();
  }

 private:
  void find_line() {
    const std::vector<pty::LineSettings> tried = settings_to_try(work_.model, work_.port);
    bool is_noisy = false;
    for (const pty::LineSettings& line : tried) {
      work_.wire.set_line(line);
      asker_.emplace(work_.wire, work_.settings.timeout + line.duration_of(100));
      work_.report(work_.port.has_settings() ? "the speed: " + pty::to_string(line) : "the chain");
      for (int i = 0; i < 2; ++i) {
        TextReply reply = asker_->ask("?VER", kPause);
        is_noisy = is_noisy || !reply.asked.reply.empty();
        const bool is_present = !reply.lines.empty() && is_text(reply.lines);
        work_.note(std::move(reply.asked));
        if (!is_present) continue;
        if (work_.port.has_settings()) work_.photo.line = pty::to_string(line);
        return;
      }
    }
    throw BoxError(silence_text(work_.port, "the chain", tried, is_noisy, work_.photo.is_echoing));
  }

  /// Returns false for an answer that a wrong speed has garbled.
  static bool is_text(const std::vector<std::string>& lines) {
    return std::ranges::all_of(lines, [](const std::string& line) {
      return std::ranges::all_of(line, [](char c) { return c >= ' ' && c <= '~'; });
    });
  }

  /// Returns the answer, if the controller gave one.
  std::optional<std::string> ask(const std::string& name) {
    work_.report(name);
    TextReply reply;
    for (int i = 0; i < 3 && reply.lines.empty(); ++i) {
      reply = asker_->ask("?" + name, kPause);
      work_.note(reply.asked);
    }
    silent_ = reply.lines.empty() ? silent_ + 1 : 0;
    if (silent_ >= 5)
      throw BoxError(one_line(work_.port.place) + ": the chain stopped answering after " +
                     std::to_string(work_.photo.exchanges.size()) +
                     " queries; expected a controller that stays on");
    if (reply.lines.empty() || reply.lines.front().starts_with(kRefused)) {
      work_.refuse({.name = name, .why = reply.lines.empty() ? "no answer" : reply.lines.front()});
      return {};
    }
    std::string text;
    for (const std::string& line : reply.lines) text += (text.empty() ? "" : "\n") + line;
    work_.photo.values.push_back({.name = name, .value = text});
    return text;
  }

  void keep(const std::string& name, const std::optional<std::string>& text) {
    const auto value = text ? parse_real(*text) : std::nullopt;
    if (!value || factory_->named_values()->value_named(name) == value) return;
    if (const auto whole = parse_integer(*text)) {
      image_.registers.emplace_back(name, *whole);
    } else {
      image_.reals.emplace_back(name, *value);
    }
  }

  /// Returns the linked modules, a bit for each. It does not try them, because a missing module becomes an
  /// error in the controller's history.
  unsigned linked_modules() {
    if (work_.settings.modules != 0) {
      work_.modules = work_.settings.modules;
      return (1U << work_.modules) - 1;
    }
    const auto text = ask(std::string(kLinkedModules));
    const auto mask = static_cast<unsigned>((text ? parse_integer(*text) : std::nullopt).value_or(1)) | 1U;
    for (int module = 0; module < kModules; ++module)
      if ((mask >> module & 1) != 0) work_.modules = module + 1;
    return mask;
  }

  void make_factory() {
    DeviceSettings settings;
    settings.name = "photograph";
    settings.firmware = work_.settings.firmware;
    settings.modules = work_.modules;
    factory_ = make_device(work_.model, settings);
    factory_->switch_power(true);
  }

  void take_module(int module) {
    const std::string of = module == 0 ? "" : "T" + std::to_string(module);
    for (const std::string_view name : kOfModule) ask(of + std::string(name));
    for (const NamedParameterRow& row : work_.model.named_parameters) {
      const std::string name = of + std::string(row.name);
      if (!factory_->named_values()->value_named(name)) continue;  // the chain has it, but not each module
      const auto value = ask(name);
      if (row.persistent) keep(name, value);
    }
  }

  void take_variables(const std::string& before, const std::string& after, int count) {
    for (int i = 0; i < count; ++i) {
      const std::string name = before + std::to_string(i) + after;
      keep(name, ask(name));
    }
  }

  /// ULP lists the program, and changes nothing.
  void take_program() {
    work_.report("the program");
    TextReply reply = asker_->ask("ULP", kPauseInList);
    work_.note(reply.asked);
    if (reply.lines.empty() || reply.lines.front().starts_with(kRefused)) {
      work_.refuse({.name = "ULP", .why = reply.lines.empty() ? "no answer" : reply.lines.front()});
      return;
    }
    if (reply.lines.back() == "END") reply.lines.pop_back();
    image_.program = std::move(reply.lines);
  }

  /// A whole real number looks like an integer in an answer; the model knows which it is.
  void settle() {
    NvImage first = image_;
    settle_image(work_, std::move(first));
    NvImage second = work_.photo.image;
    for (const auto& [name, why] : std::exchange(work_.photo.left_out, {})) {
      const auto of_name = [&name = name](const auto& entry) { return entry.first == name; };
      const auto whole = std::ranges::find_if(image_.registers, of_name);
      if (whole != image_.registers.end()) {
        second.reals.emplace_back(name, static_cast<double>(whole->second));
      } else {
        work_.photo.left_out.emplace_back(name, why);
      }
    }
    settle_image(work_, std::move(second));
  }

  PhotoWork& work_;
  std::optional<TextAsker> asker_;
  std::unique_ptr<Device> factory_;
  NvImage image_;
  int silent_ = 0;  // queries without an answer, in a row
};

}  // namespace

void photograph_text(PhotoWork& work) { TextPhoto(work).take(); }

}  // namespace understudy::emulator::box
