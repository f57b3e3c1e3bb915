// Implements `photograph`: reads all readable data of a real controller.
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/growing_file.h"
#include "base/files/output_file.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/photograph/photo_file.h"
#include "emulator/box/photograph/photograph.h"
#include "emulator/box/wire/port_name.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/interruption.h"
#include "emulator/command_line/model_option.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/result_file.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

namespace {

constexpr std::string_view kImageEnding = ".nv.json";

std::string photo_next_to(const std::string& image) {
  return image.substr(0, image.size() - kImageEnding.size()) + ".photo.json";
}

box::PortName require_port(const std::string& text) {
  try {
    return box::parse_port_name(text);
  } catch (const box::PortNameError& error) {
    throw UsageError("photograph: " + std::string(error.what()));
  }
}

box::PhotoSettings settings_of(const Model& model, const PhotographArguments& arguments) {
  const auto timeout = parse_duration(arguments.timeout);
  if (!timeout || *timeout < std::chrono::milliseconds(1) || *timeout > std::chrono::hours(1))
    throw UsageError("--timeout: " + quoted(arguments.timeout) +
                     " is not a duration; expected one such as 300ms");
  if (arguments.station && !model.rtu)
    throw UsageError("--station: " + std::string(model.name) +
                     " has no station number; expected no --station");
  if (arguments.station && (*arguments.station < 0 || *arguments.station > 247))
    throw UsageError("--station: expected 0 to 247");
  if (arguments.modules && (*arguments.modules < 1 || *arguments.modules > model.max_modules))
    throw UsageError("--modules: " + std::string(model.name) + " has " +
                     (model.max_modules == 0 ? "no modules; expected no --modules"
                                             : "at most " + std::to_string(model.max_modules) +
                                                   "; expected 1 to " + std::to_string(model.max_modules)));
  if (arguments.arrays && model.rtu)
    throw UsageError("--arrays: " + std::string(model.name) +
                     " has no long arrays; expected no --arrays: all its registers are read");
  return {.station = arguments.station,
          .firmware = require_firmware(model, arguments.firmware),
          .timeout = *timeout,
          .modules = arguments.modules.value_or(0),
          .has_arrays = arguments.arrays,
          .is_over = is_interrupted};
}

/// Checks a path without creating anything. This happens before the controller is read, which takes seconds
/// or minutes.
void require_writable(FileClaims& claims, const std::string& path, ContentKind kind) {
  require_output(claims, "--output", path);
  if (const std::string why = why_not_openable(path, kind); !why.empty())
    throw GrowingFileError("--output: " + path + " cannot be written: " + why);
}

/// Shows progress on a terminal.
class AskedLine {
 public:
  ~AskedLine() {
    if (is_shown_) std::fputs("\r\x1b[K", stderr);
  }
  void show(std::size_t requests, std::string_view next) {
    if (!is_terminal_) return;
    is_shown_ = true;
    std::fprintf(stderr, "\r\x1b[K%zu requests; next: %s", requests, one_line(next).c_str());
  }

 private:
  const bool is_terminal_ = isatty(STDERR_FILENO) != 0 && std::getenv("CI") == nullptr;
  bool is_shown_ = false;
};

box::Photograph photograph_with_progress(const Model& model, const box::PortName& port,
                                         const box::PhotoSettings& settings) {
  AskedLine asked;
  return box::photograph(model, port, settings,
                         [&](std::size_t requests, std::string_view next) { asked.show(requests, next); });
}

std::string in_milliseconds(std::chrono::nanoseconds time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", std::chrono::duration<double, std::milli>(time).count());
  return text;
}

void summarize(const box::Photograph& photo, const std::string& image, const std::string& file) {
  const box::Latencies latencies = box::latencies_of(photo);
  std::printf("%s%s: %zu values, %zu refused, in %zu requests of %s to %s ms (median %s)\n",
              one_line(photo.place).c_str(), photo.line.empty() ? "" : (" at " + photo.line).c_str(),
              photo.values.size(), photo.refused.size(), photo.exchanges.size(),
              in_milliseconds(latencies.min).c_str(), in_milliseconds(latencies.max).c_str(),
              in_milliseconds(latencies.median).c_str());
  if (photo.is_echoing) std::printf("the adapter echoes: a bench needs `echo: on` for the line\n");
  for (const auto& [name, why] : photo.left_out)
    std::printf("not in the image, %s: %s\n", one_line(name).c_str(), one_line(why).c_str());
  const std::size_t entries = photo.image.registers.size() + photo.image.reals.size();
  std::printf("wrote %s: %zu values that differ from the factory values%s\n", image.c_str(), entries,
              photo.image.program.empty() ? "" : ", and the program");
  std::printf("wrote %s\n", file.c_str());
}

/// Writes the photograph without an image, which would say that everything else has its factory value.
int keep_part(const box::Photograph& photo, const std::string& file) {
  std::fprintf(stderr, "understudy: photograph: %s\n", one_line(photo.ended).c_str());
  ResultFile("--output", file, ContentKind::photograph).replace(box::photo_json(photo));
  std::printf(
      "wrote %s: the %zu values that were read, in %zu requests; no image, because others are missing\n",
      file.c_str(), photo.values.size(), photo.exchanges.size());
  return kExitFailed;
}

}  // namespace

int take_photograph(ModelList models, const PhotographArguments& arguments) {
  const Model& model = require_model(models, arguments.model);
  const box::PortName port = require_port(arguments.port);
  const box::PhotoSettings settings = settings_of(model, arguments);
  if (!arguments.output.ends_with(kImageEnding) || arguments.output.size() == kImageEnding.size())
    throw UsageError("--output: " + quoted(arguments.output) +
                     " is not the name of an NV image; expected a name that ends in .nv.json");
  const std::string photo_path = photo_next_to(arguments.output);
  FileClaims claims;
  require_writable(claims, arguments.output, ContentKind::nv_image);
  require_writable(claims, photo_path, ContentKind::photograph);
  watch_for_interruption();
  try {
    const box::Photograph photo = photograph_with_progress(model, port, settings);
    if (!photo.ended.empty()) return keep_part(photo, photo_path);
    ResultFile("--output", arguments.output, ContentKind::nv_image).replace(to_json(photo.image));
    ResultFile("--output", photo_path, ContentKind::photograph).replace(box::photo_json(photo));
    summarize(photo, arguments.output, photo_path);
  } catch (const box::BoxError& error) {
    std::fprintf(stderr, "understudy: photograph: %s\n", error.what());
    return kExitFailed;
  }
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
