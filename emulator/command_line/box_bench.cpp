#include "emulator/command_line/box_bench.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <ios>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_error.h"
#include "base/files/text_file.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/followed_file.h"
#include "emulator/box/capture/recorded_capture.h"
#include "emulator/box/compare/input_log.h"
#include "emulator/box/compare/replay_bench.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/interruption.h"
#include "emulator/command_line/text_argument.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/nv_file.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_file.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::command_line {

namespace {

std::size_t require_line(const world::Bench& bench, const std::string& command, const std::string& name) {
  std::string names;
  for (std::size_t i = 0; i < bench.lines.size(); ++i) {
    if (bench.lines[i].name == name || (name.empty() && bench.lines.size() == 1)) return i;
    names += (names.empty() ? "" : ", ") + bench.lines[i].name;
  }
  if (name.empty())
    throw UsageError(command + ": the bench has several lines; expected --line with one of " + names);
  throw UsageError("--line: the bench has no line called " + quoted(name) + "; expected one of " + names);
}

/// Reads the devices' memories from the file of `--from`, or from the files in the bench.
void read_memories(world::Bench& bench, std::size_t line, const std::string& from) {
  for (world::DeviceSetup& device : bench.devices) {
    if (device.nv_path.empty()) continue;
    if (auto image = read_nv_file(device.nv_path)) device.settings.nv = std::move(image);
  }
  if (from.empty()) return;
  const auto image = read_nv_file(from);
  if (!image) throw UsageError("--from: " + from + ": does not exist; expected an NV image");
  for (const world::StationSetup& station : bench.lines[line].stations) {
    world::DeviceSetup& device = bench.devices[station.device];
    if (device.model->name != image->model) continue;
    device.settings.nv = image;
    return;
  }
  throw UsageError("--from: " + from + ": is for " + quoted(image->model) +
                   ", but the line has no device of that model; expected an image for a device on the line");
}

/// Returns the number of the only station on the line, or nothing if the line has several stations or a text
/// protocol.
std::optional<std::uint8_t> only_station(const box::ReplayBench& bench) {
  std::optional<std::uint8_t> only;
  for (const auto& station : bench.line().stations) {
    const ModbusStation* const modbus = station->device().modbus();
    for (int number = 0; modbus != nullptr && number < 256; ++number) {
      if (modbus->addressing(static_cast<std::uint8_t>(number)) != Addressing::execute_and_reply) continue;
      if (only) return {};
      only = static_cast<std::uint8_t>(number);
    }
  }
  return only;
}

void set_station(box::CapturedBytes& frame, std::uint8_t number) {
  if (frame.size() < 4) return;
  frame[0] = number;
  frame.resize(frame.size() - 2);
  pty::append_rtu_crc(frame);
}

box::CaptureSettings capture_settings(const BoxBench& box, const CompareArguments& arguments) {
  box::CaptureSettings settings{.line = arguments.line, .pattern = arguments.pattern};
  const auto& stations = box.bench.lines[box.settings.line].stations;
  settings.is_text =
      !stations.empty() && &box.bench.devices[stations.front().device].model->line.protocol != &kModbusRtu;
  if (!arguments.every.empty()) {
    settings.every = parse_duration(arguments.every);
    if (!settings.every || settings.every->count() == 0)
      throw UsageError("--every: " + quoted(arguments.every) +
                       " is not an interval; expected a duration such as 20ms");
  }
  if (arguments.sample_rate > 0) settings.sample_rate = arguments.sample_rate;
  // A growing capture has its own end (FollowedFile).
  if (!arguments.follow) settings.is_over = is_interrupted;
  return settings;
}

}  // namespace

BoxBench read_box_bench(ModelList models, const std::string& command, const CompareArguments& arguments) {
  BoxBench box;
  const auto tolerance = parse_duration(arguments.tolerance);
  if (!tolerance || *tolerance > std::chrono::seconds(10))
    throw UsageError("--tolerance: " + quoted(arguments.tolerance) +
                     " is not a duration; expected one such as 1ms");
  box.bench = world::load_bench(models, arguments.bench);
  box.settings.line = require_line(box.bench, command, arguments.line);
  box.settings.tolerance = *tolerance;
  box.settings.from_power_up = arguments.power_up;
  read_memories(box.bench, box.settings.line, arguments.from);
  if (!arguments.inputs.empty()) {
    const auto text = read_text_argument(arguments.inputs);
    if (!text)
      throw FileError(arguments.inputs + ": inputs: " + text.why + "; expected a file of input changes");
    box.settings.inputs = box::parse_input_log(box.bench, *text, arguments.inputs);
    box.settings.knows_inputs = true;
  }
  box.reading = capture_settings(box, arguments);
  return box;
}

StationFilter::StationFilter(const BoxBench& box)
    : box_(box), stations_(box.bench, box.settings.line), only_(only_station(stations_)) {}

bool StationFilter::keeps(box::Exchange& exchange, box::CaptureNotes& notes) {
  if (exchange.request.empty()) return false;
  const bool is_anyone = exchange.request[0] == 0 || exchange.request[0] == 255;
  if (!box_.reading.is_text && notes.is_modbus_tcp && is_anyone && only_) {
    set_station(exchange.request, *only_);
    set_station(exchange.reply, *only_);
  }
  if (box_.reading.is_text || stations_.bank_of(exchange.request) != nullptr) return has_kept_ = true;
  others_.insert(exchange.request[0]);
  ++notes.elsewhere;
  return false;
}

void StationFilter::require_some(const std::string& path) const {
  if (has_kept_) return;
  std::string numbers;
  for (const int number : others_) numbers += (numbers.empty() ? "" : ", ") + std::to_string(number);
  throw FileError(path + ": all requests are to station " + numbers + ", which is not on line " +
                  quoted(box_.bench.lines[box_.settings.line].name) +
                  " of the bench; expected a capture of " +
                  (only_ ? "station " + std::to_string(*only_) : std::string("one of its stations")));
}

box::CaptureNotes take_exchanges(ModelList models, const BoxBench& box, const std::string& path,
                                 const ExchangeTaker& take) {
  if (const std::string why = why_not_readable(path); !why.empty())
    throw FileError(path + ": capture: " + why + "; expected a capture");
  const std::string head = head_of_file(path);
  const bool is_recording = content_of(head) == ContentKind::recording;
  if (const std::string why = is_another_kind(head, ContentKind::capture); !why.empty() && !is_recording)
    throw FileError({path, 1, 1}, "capture: " + why);
  std::ifstream file(path, std::ios::binary);
  StationFilter filter(box);
  if (is_recording) {
    box::Capture capture = box::read_recorded_capture(models, file, path, box.reading, box.bench);
    for (box::Exchange& exchange : capture.exchanges) {
      if (is_interrupted()) return capture.notes;
      if (filter.keeps(exchange, capture.notes)) take(std::move(exchange), capture.notes, capture.inputs);
    }
    filter.require_some(path);
    return capture.notes;
  }
  box::CaptureNotes notes;
  try {
    box::read_exchanges(file, head, path, box.reading, notes, [&](box::Exchange exchange) {
      if (filter.keeps(exchange, notes)) take(std::move(exchange), notes, {});
    });
  } catch (const box::CaptureInterrupted&) {
    return notes;
  }
  filter.require_some(path);
  return notes;
}

box::CaptureNotes follow_exchanges(const BoxBench& box, const std::string& path, const ExchangeTaker& take) {
  box::FollowedFile followed(path, is_interrupted);
  const std::string head = followed.head();
  if (head.empty()) throw FileError(path + ": capture: is still empty; expected a capture that has begun");
  if (const std::string why = is_another_kind(head, ContentKind::capture); !why.empty())
    throw FileError({path, 1, 1}, "capture: " + why);
  std::istream file(&followed);
  StationFilter filter(box);
  box::CaptureNotes notes;
  box::read_exchanges(file, head, path, box.reading, notes, [&](box::Exchange exchange) {
    if (filter.keeps(exchange, notes)) take(std::move(exchange), notes, {});
  });
  filter.require_some(path);
  return notes;
}

std::vector<box::Capture> read_captures(ModelList models, const BoxBench& box,
                                        const std::vector<std::string>& paths) {
  std::vector<box::Capture> captures;
  for (const std::string& path : paths) {
    box::Capture capture{.path = path, .line = {}, .exchanges = {}};
    capture.notes = take_exchanges(
        models, box, path,
        [&](box::Exchange exchange, const box::CaptureNotes&, const std::vector<box::InputChange>& inputs) {
          if (capture.exchanges.empty()) capture.inputs = inputs;
          capture.exchanges.push_back(std::move(exchange));
        });
    capture.line = capture.notes.line;
    captures.push_back(std::move(capture));
  }
  return captures;
}

std::vector<std::string> notes_text(const box::CaptureNotes& notes) {
  std::vector<std::string> texts;
  const auto add = [&](std::size_t count, const std::string& one, const std::string& several) {
    if (count != 0) texts.push_back(std::to_string(count) + " " + (count == 1 ? one : several));
  };
  if (!notes.begins_at_power_up || notes.knows_beginning) texts.push_back("read as " + notes.format);
  if (!notes.beyond_the_line.empty())
    texts.push_back("from " + notes.beyond_the_line +
                    " on, differences are undecidable, because the bench does not repeat this");
  if (notes.is_side_inferred)
    texts.emplace_back("the host's and the controller's bytes were distinguished by their frames");
  add(notes.bytes_of_no_frame, "byte is outside a frame", "bytes are outside frames");
  add(notes.unasked, "reply follows no request", "replies follow no request");
  add(notes.elsewhere, "request is to a station that is not in the bench",
      "requests are to stations that are not in the bench");
  add(notes.restored_requests, "request was lost, but its reply repeats it",
      "requests were lost, but their replies repeat them");
  if (notes.lost_requests != 0)
    texts.push_back(
        "from " + std::to_string(notes.lost_requests) +
        (notes.lost_requests == 1 ? " lost request on, differences" : " lost requests on, differences") +
        " are undecidable, because a lost request may have written something");
  return texts;
}

std::string why_no_capture_is_expected(std::string_view head, ContentKind expected) {
  if (std::string why = is_another_kind(head, expected); !why.empty()) return why;
  if (content_of(head) == expected) return "";
  const std::string format = box::capture_format(std::string(head.substr(0, kSniffedBytes)));
  return format.empty()
             ? ""
             : "is " + format + ", for `understudy compare`; expected " + std::string(name_of(expected));
}

std::string choice_text(const world::Bench& bench, std::size_t device, const std::string& id) {
  return bench.devices[device].settings.name + "." + id;
}

}  // namespace understudy::emulator::command_line
