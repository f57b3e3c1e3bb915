// Reports which lines of the devices' programs have run.
#include <cstddef>
#include <string>
#include <utility>

#include "emulator/device/device.h"
#include "emulator/device/user_program.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/reply_text.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/coverage/coverage_report.h"
#include "emulator/world/coverage/program_coverage.h"

namespace understudy::emulator::serve {

namespace {

Json coverage_json(const world::CoverageTotals& totals) {
  return Json{{"lines", totals.lines},
              {"lines_run", totals.lines_run},
              {"branches", totals.branches},
              {"branches_taken", totals.branches_taken}};
}

Json coverage_json(const std::string& path, const world::CoveredFile& file) {
  Json lines = Json::array();
  for (const auto& [number, line] : file.lines) {
    Json entry{number, line.runs};
    if (line.decides) {
      entry.push_back(line.yes);
      entry.push_back(line.no);
    }
    lines.push_back(std::move(entry));
  }
  Json json{{"path", path}, {"totals", coverage_json(file.totals())}, {"lines", std::move(lines)}};
  if (!file.listing.empty()) json["listing"] = file.listing;
  return json;
}

}  // namespace

ReplyTask coverage_message(Daemon& daemon, Json message) {
  require_keys(message, {"do", "device", "again"});
  const Pause pause(daemon);
  const std::size_t count = daemon.world().device_count();
  const bool is_of_one = message.contains("device");
  const std::size_t only = is_of_one ? require_device(daemon, message) : 0;
  if (is_of_one && daemon.world().device(only).user_program() == nullptr) {
    throw MessageError("device: " + daemon.world().device(only).name() +
                       " runs no programs; expected a device that does");
  }
  Observers& observers = daemon.observers();
  if (flag_or_false(message, "again") || observers.coverage == nullptr) observers.count_lines(daemon.world());
  const SimTime since = observers.counted_since;
  world::CoverageReport report;
  for (std::size_t d = 0; d < count; ++d) {
    if (!is_of_one || d == only) report.add(observers.coverage->report_of(d));
    co_await pause;
  }
  ReplyText text;
  text.member("since_ns", since.count());
  text.member("totals", coverage_json(report.totals()));
  text.open_list("covered");
  for (const auto& [path, file] : report.files) {
    text.element(coverage_json(path, file));
    co_await pause;
  }
  text.close_list();
  co_return text.take();
}

}  // namespace understudy::emulator::serve
