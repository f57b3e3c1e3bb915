#include "emulator/command_line/device_coverage_file.h"

#include <cstddef>
#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/report/touched_page.h"
#include "emulator/play/results/result.h"
#include "emulator/world/coverage/controller_coverage.h"
#include "emulator/world/coverage/touched.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

namespace {

bool is_device_page(const std::string& path) { return path.ends_with(".html"); }

class DeviceObserver final : public play::Observer {
 public:
  DeviceObserver(world::World& world, DeviceCoverageFile& file) : coverage_(world), file_(file) {}
  void world_restored(std::size_t /*steps*/) override { coverage_.world_restored(); }
  void finish(play::ScenarioResult& /*result*/) override { file_.add(coverage_.report()); }

 private:
  world::ControllerCoverage coverage_;
  DeviceCoverageFile& file_;
};

}  // namespace

void require_device_coverage(FileClaims& claims, const std::string& path) {
  if (!path.empty() && !path.ends_with(".json") && !is_device_page(path)) {
    throw UsageError("--device-coverage: " + path +
                     " has an unknown format; expected FILE.json or FILE.html (a page)");
  }
  require_output(claims, "--device-coverage", path);
}

DeviceCoverageFile::DeviceCoverageFile(const std::string& path, std::string version)
    : path_(path),
      version_(std::move(version)),
      file_("--device-coverage", path, is_device_page(path) ? ContentKind::page : ContentKind::coverage) {}

void DeviceCoverageFile::add(const world::TouchedReport& report) {
  const std::lock_guard lock(mutex_);
  report_.add(report);
}

play::ObserverMaker DeviceCoverageFile::observer() {
  return [this](world::World& world) { return std::make_unique<DeviceObserver>(world, *this); };
}

void DeviceCoverageFile::write(std::FILE* out) {
  if (is_wanted())
    file_.write(is_device_page(path_) ? play::touched_page(report_, version_) : world::json_text(report_));
  std::fprintf(out, "%s", play::touched_text(report_).c_str());
}

}  // namespace understudy::emulator::command_line
