#include "emulator/command_line/serving.h"

#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/files/growing_file.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/coverage_file.h"
#include "emulator/command_line/device_coverage_file.h"
#include "emulator/command_line/findings.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/model_option.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/device/firmware_message.h"
#include "emulator/device/model.h"
#include "emulator/serve/control/control_door.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/daemon/nv_keeper.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/serve/ports/port_group.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench/listening.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/bench_file/program_warnings.h"
#include "emulator/world/names/names.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/recording/recording_spool.h"
#include "emulator/world/trace/trace.h"
#include "pty/line.h"
#include "pty/line_settings.h"
#include "pty/port_link.h"

namespace understudy::emulator::command_line {

namespace {

pty::Timing require_timing(const std::string& timing) {
  if (timing == "wire") return pty::Timing::wire;
  if (timing == "instant") return pty::Timing::instant;
  throw UsageError("--timing: " + understudy::quoted(timing) + " is unknown; expected wire or instant");
}

/// Reports the model's error about a setting as an error in the corresponding flag.
void require_possible(const world::DeviceSetup& device) {
  try {
    make_device(*device.model, device.settings);
  } catch (const SettingError& error) {
    const std::string flag = error.setting == "address" ? "--station" : "--" + error.setting;
    throw UsageError(flag + std::string(error.what()).substr(error.setting.size()));
  }
}

/// Returns a bench with one device on all its ports, as described by the flags.
world::Bench bench_of_flags(ModelList models, const ServeArguments& arguments) {
  std::vector<FileClaim> files;
  world::DeviceSetup device{.model = &require_model(models, arguments.model, files), .settings = {}};
  device.settings.name = "device";
  device.settings.address = arguments.station;
  if (arguments.station && !device.model->line.station_numbers) {
    throw UsageError("--station: " + std::string(device.model->name) +
                     " has no station number; expected no --station");
  }
  device.settings.modules = arguments.modules.value_or(0);
  if (arguments.modules == 0) throw UsageError("--modules: 0 is too few; expected 1 or more");
  if (arguments.baud == 0)
    throw UsageError("--baud: 0 is not a speed; expected a speed of the model, such as 19200 or 115200");
  device.settings.bauds.assign(device.model->line.ports.size(), arguments.baud.value_or(0));
  if (!arguments.firmware.empty()) {
    device.settings.firmware = parse_firmware(arguments.firmware);
    if (device.settings.firmware == 0)
      throw UsageError("--firmware: " + why_no_firmware(*device.model, arguments.firmware));
  }
  require_possible(device);
  std::string link = arguments.link;
  if (one_line(link) != link) {
    throw UsageError("--link: " + link + ": has a control character; expected a path without one");
  }
  if (!link.empty()) link = (std::filesystem::path(arguments.links) / link).string();
  world::Bench bench = world::bench_of_one(*device.model, device.settings, link);
  bench.files = std::move(files);
  return bench;
}

/// Parses the address after [LINE=].
world::TcpAddress address_wished(const std::string& wish, std::size_t begin) {
  try {
    return world::parse_tcp_address(std::string_view(wish).substr(begin));
  } catch (const world::ListeningError& error) {
    throw UsageError("--listen: " + understudy::quoted(wish) + " " + error.what());
  }
}

/// Parses [LINE=]rtu://[HOST]:PORT, and adds the address to that line, or to the only line.
void listen_as_wished(world::Bench& bench, const std::string& wish) {
  const std::size_t equals = wish.substr(0, wish.find("://")).rfind('=');
  const bool names_line = equals != std::string::npos;
  const world::TcpAddress address = address_wished(wish, names_line ? equals + 1 : 0);
  for (const world::LineSetup& line : bench.lines) {
    const auto is_present = [&](const world::TcpAddress& other) { return is_same_place(address, other); };
    if (std::ranges::any_of(line.tcp, is_present))
      throw UsageError("--listen: " + understudy::quoted(wish) + ": line " + line.name +
                       " already listens there; expected another port");
  }
  const std::string name = names_line ? wish.substr(0, equals) : "";
  std::string lines;
  for (world::LineSetup& line : bench.lines) {
    lines += (lines.empty() ? "" : ", ") + line.name;
    if (names_line ? line.name != name : bench.lines.size() > 1) continue;
    const Model& model = *bench.devices[line.stations.front().device].model;
    if (address.protocol == world::TcpProtocol::modbus_tcp && world::protocol_of(model).carries_text()) {
      throw UsageError("--listen: " + understudy::quoted(wish) + ": the line " + line.name +
                       " carries lines of text, not Modbus; expected rtu:// or rfc2217://, which carry any "
                       "bytes");
    }
    line.tcp.push_back(address);
    return;
  }
  throw UsageError(
      "--listen: " +
      (names_line ? understudy::quoted(name) + " is not a line" : std::string("does not name a line")) +
      "; expected LINE=... with one of " + lines);
}

void require_no_pty(world::Bench& bench, const ServeArguments& arguments) {
  if (!arguments.link.empty())
    throw UsageError("--no-pty: --link needs a pseudo-terminal; expected one of the two");
  bool listens = false;
  for (world::LineSetup& line : bench.lines) {
    if (line.tcp.empty()) continue;
    listens = true;
    line.has_pty = false;
    line.link.clear();
  }
  if (!listens) throw UsageError("--no-pty: no line listens on TCP; expected --listen");
}

world::Bench make_bench(ModelList models, const ServeArguments& arguments, const std::string& command) {
  if (arguments.bench.empty() == arguments.model.empty()) {
    throw UsageError(command + ": expected either a bench file or --model MODEL");
  }
  const bool flags_of_one = arguments.station || arguments.modules || arguments.baud ||
                            !arguments.firmware.empty() || !arguments.link.empty();
  if (!arguments.bench.empty() && flags_of_one) {
    throw UsageError(command +
                     ": --station, --modules, --firmware, --baud and --link need --model; a bench file "
                     "defines these settings itself");
  }
  world::Bench bench = arguments.bench.empty() ? bench_of_flags(models, arguments)
                                               : world::load_bench(models, arguments.bench, arguments.links);
  for (world::LineSetup& line : bench.lines) {
    if (!arguments.links.empty() && line.link.empty() && line.has_pty)
      line.link = arguments.links + "/" + line.name + ".port";
  }
  if (!arguments.timing.empty()) {
    for (world::LineSetup& line : bench.lines) line.timing = require_timing(arguments.timing);
  }
  if (!arguments.baud_tolerance.empty()) {
    const auto ppm = world::parse_baud_tolerance(arguments.baud_tolerance);
    if (!ppm) {
      throw UsageError("--baud-tolerance: " + understudy::quoted(arguments.baud_tolerance) +
                       " is not valid; " + std::string(world::kBaudToleranceExpected));
    }
    for (world::LineSetup& line : bench.lines) line.baud_tolerance_ppm = *ppm;
  }
  if (!arguments.byte_timeout.empty()) {
    const auto time = world::parse_byte_timeout(arguments.byte_timeout);
    if (!time) {
      throw UsageError("--byte-timeout: " + understudy::quoted(arguments.byte_timeout) + " is not valid; " +
                       std::string(world::kByteTimeoutExpected));
    }
    for (world::LineSetup& line : bench.lines) line.byte_timeout = *time;
  }
  for (const std::string& wish : arguments.listen) listen_as_wished(bench, wish);
  if (arguments.no_pty) require_no_pty(bench, arguments);
  return bench;
}

/// Returns the files that the bench uses: its own files, the memories (which are also written), the links and
/// the control socket.
FileClaims claims_of(const world::Bench& bench, const std::string& control) {
  FileClaims claims;
  claims.add(bench.files);
  for (const world::DeviceSetup& device : bench.devices) {
    claims.add({device.nv_path, "the memory of " + understudy::quoted(device.settings.name)});
  }
  for (const world::LineSetup& line : bench.lines) {
    claims.add_place({line.link, "the link of line " + understudy::quoted(line.name)});
  }
  claims.add_place({control, "the control socket"});
  return claims;
}

/// Throws UsageError if one of these names is not a signal of the bench.
void require_names(const world::Bench& bench, const std::vector<std::string>& also) {
  if (also.empty()) return;
  try {
    world::trace_signals(world::World(bench, {}, {}), also);
  } catch (const world::NameError& error) {
    throw UsageError(std::string("--trace-also: ") + error.what());
  }
}

/// Claims the recording and the file for its older part.
std::string require_recording(const std::string& path, FileClaims& claims) {
  const std::string older = older_part_of(path);
  require_output(claims, "--record", older);
  const std::string why = older.empty() ? "" : world::why_no_older_part(older);
  if (!why.empty()) {
    throw GrowingFileError("--record: " + older +
                           ", to which the older part is moved, cannot be written: " + why);
  }
  return require_output(claims, "--record", path);
}

std::optional<gid_t> require_group(const std::string& name) {
  if (name.empty()) return std::nullopt;
  const auto group = serve::find_group(name);
  if (!group)
    throw UsageError("--group: " + understudy::quoted(name) +
                     " is unknown; expected a group such as dialout");
  return group;
}

}  // namespace

Serving make_serving(ModelList models, const ServeArguments& arguments, const std::string& command) {
  Serving serving;
  serving.bench = make_bench(models, arguments, command);
  serve::read_memories(serving.bench, arguments.nv);
  serve::DaemonOptions& options = serving.options;
  options.strict_framing = arguments.strict_framing;
  options.enforce_settings = !arguments.ignore_baud;
  options.door = serve::control_door(arguments.control);
  if (!arguments.bench.empty())
    options.bench_path = std::filesystem::weakly_canonical(arguments.bench).string();
  options.files = claims_of(serving.bench, arguments.control);
  options.capture_path = require_capture(options.files, arguments.capture);
  options.record_path = require_recording(arguments.record, options.files);
  options.trace_path = require_trace(options.files, arguments.trace, arguments.trace_also);
  require_coverage(options.files, {.path = arguments.coverage, .min_percent = {}});
  require_device_coverage(options.files, arguments.device_coverage);
  require_names(serving.bench, arguments.trace_also);
  options.trace_also = arguments.trace_also;
  options.version = arguments.version;
  const auto speed = serve::parse_speed(arguments.speed);
  if (!speed) {
    throw UsageError("--speed: " + understudy::quoted(arguments.speed) +
                     " is unknown; expected real, free, manual or a factor such as 10x");
  }
  options.speed = *speed;
  serving.group = require_group(arguments.group);
  for (const FileError::Diagnostic& odd : world::program_warnings(serving.bench)) log_line(warning_line(odd));
  return serving;
}

namespace {

/// Prints a hint only on terminals, because in a script's log it would look like an error.
void print_parity_hint(const serve::Daemon& daemon) {
  if (isatty(STDERR_FILENO) == 0) return;
  for (const auto& port : daemon.ports()) {
    const pty::Line& line = daemon.world().line(port->line_number()).line;
    if (line.options().settings.parity == pty::Parity::none || port->terminal() == nullptr) continue;
    log_line(
        "line " + line.name() + " is " + pty::to_string(line.options().settings) +
        "; a pseudo-terminal has no parity, so hosts with pyserial, minimalmodbus or pymodbus that report "
        "\"Invalid "
        "argument\" need LD_PRELOAD=$(understudy tty-shim)");
    return;
  }
}

}  // namespace

void print_ready(const serve::Daemon& daemon) {
  print_parity_hint(daemon);
  for (const auto& port : daemon.ports()) {
    const std::string place = port->place();
    std::printf("ready %s %s %s\n", daemon.world().line(port->line_number()).line.name().c_str(),
                port->terminal() != nullptr ? port->terminal()->path().c_str() : place.c_str(),
                place.c_str());
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw pty::PortError(
        "standard output cannot be written; expected an open standard output for the `ready` lines");
  }
}

void print_findings(const std::vector<std::string>& findings) {
  for (const std::string& finding : findings) std::fprintf(stderr, "lint: %s\n", one_line(finding).c_str());
}

}  // namespace understudy::emulator::command_line
