#include "emulator/command_line/ctl_coverage.h"

#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "base/files/file_claims.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/coverage_file.h"
#include "emulator/play/report/coverage_page.h"
#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::command_line {

namespace {

using Json = nlohmann::ordered_json;

world::CoverageReport report_of(const Json& reply) {
  world::CoverageReport report;
  for (const Json& file : reply.at("covered")) {
    world::CoveredFile& own = report.files[file.at("path").get<std::string>()];
    own.listing = file.value("listing", std::string());
    for (const Json& line : file.at("lines")) {
      world::CoveredLine& counts = own.lines[line.at(0).get<int>()];
      counts.runs = line.at(1).get<std::int64_t>();
      counts.decides = line.size() > 2;
      if (!counts.decides) continue;
      counts.yes = line.at(2).get<std::int64_t>();
      counts.no = line.at(3).get<std::int64_t>();
    }
  }
  return report;
}

/// Returns the lines that have not run, such as "5-6, 9".
std::string lines_left(const world::CoveredFile& file) {
  std::string text;
  int begin = 0;
  int end = 0;
  const auto close = [&] {
    if (begin == 0) return;
    text += (text.empty() ? "" : ", ") + std::to_string(begin);
    if (end > begin) text += "-" + std::to_string(end);
    begin = 0;
  };
  for (const auto& [number, line] : file.lines) {
    if (line.runs > 0) {
      close();
      continue;
    }
    if (begin == 0) begin = number;
    end = number;
  }
  close();
  return text;
}

}  // namespace

void print_files(const world::CoverageReport& report) {
  for (const auto& [path, file] : report.files) {
    const std::string left = lines_left(file);
    const std::string text = path + ": " + play::coverage_text(file.totals());
    std::printf("%s\n", one_line(text + (left.empty() ? "" : "; not run: " + left)).c_str());
  }
}

void print_coverage(const Json& reply) {
  const world::CoverageReport report = report_of(reply);
  const SimTime since{reply.at("since_ns").get<std::int64_t>()};
  std::printf("since %s: %s\n", format_duration(since).c_str(), play::coverage_text(report.totals()).c_str());
  print_files(report);
}

void write_coverage(const Json& reply, const ControlArguments& arguments) {
  const CoverageWish wish{.path = arguments.output, .min_percent = {}, .version = arguments.version};
  FileClaims claims;
  require_coverage(claims, wish, "--output");
  CoverageFile file(wish, "--output");
  file.add(report_of(reply));
  file.write(stdout);
}

}  // namespace understudy::emulator::command_line
