// Photographs a controller on Modbus: all registers, in blocks, and one by one where a block is refused.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/box/asking/modbus_master.h"
#include "emulator/box/photograph/photo_parts.h"
#include "emulator/box/photograph/photograph.h"
#include "emulator/box/photograph/read_plan.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/free_executor.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

namespace {

using Kind = play::HostReply::Kind;

constexpr int kUnknownFunction = 1;
constexpr int kBusy = 6;
constexpr int kTries = 3;

std::string why_refused(const play::HostReply& reply) {
  switch (reply.kind) {
    case Kind::exception: return "exception " + std::to_string(reply.exception);
    case Kind::garbled: return "no valid reply";
    case Kind::silence:
    case Kind::good: break;
  }
  return "no answer";
}

class RegisterPhoto {
 public:
  explicit RegisterPhoto(PhotoWork& work)
      : work_(work), map_(*work.model.registers), plan_(read_plan(work.model)), device_(blank_device(work)) {
    low_word_first_ = map_.policy().low_word_first;
    station_ = work.settings.station.value_or(device_->station_number().value_or(1));
    work.photo.station = station_;
  }

  void take() {
    find_line();
    find_word_order();
    for (const ReadBlock& block : plan_) read_block(block);
    settle_image(work_, std::move(image_));
  }

 private:
  static std::unique_ptr<Device> blank_device(const PhotoWork& work) {
    DeviceSettings settings;
    settings.name = "photograph";
    settings.firmware = work.settings.firmware;
    return make_device(work.model, settings);
  }

  ModbusMaster master_at(const pty::LineSettings& line) const {
    const WallTime of_line = work_.port.has_settings() ? line.duration_of(270) : WallTime{0};
    return ModbusMaster(work_.wire, {.station = station_,
                                     .timeout = work_.settings.timeout + of_line,
                                     .silence = play::silence_between_frames(line),
                                     .is_tcp = work_.port.is_modbus_tcp()});
  }

  /// Tries the settings until the controller answers, if only with an exception.
  void find_line() {
    const std::vector<pty::LineSettings> tried = settings_to_try(work_.model, work_.port);
    const ReadCell& first = plan_.front().cells.front();
    bool is_noisy = false;
    int other_station = -1;
    for (const pty::LineSettings& line : tried) {
      work_.wire.set_line(line);
      master_.emplace(master_at(line));
      work_.report(work_.port.has_settings() ? "the speed: " + pty::to_string(line) : "the station");
      for (int i = 0; i < 2; ++i) {
        ReadReply read = master_->read(plan_.front().table, first.address, first.size);
        const Kind kind = read.reply.kind;
        is_noisy = is_noisy || (kind == Kind::garbled && read.other_station < 0);
        if (read.other_station >= 0) other_station = read.other_station;
        work_.note(std::move(read.asked));
        if (kind != Kind::good && kind != Kind::exception) continue;
        if (work_.port.has_settings()) work_.photo.line = pty::to_string(line);
        return;
      }
    }
    const std::string who = "station " + std::to_string(station_);
    if (other_station >= 0)
      throw BoxError(one_line(work_.port.place) + ": station " + std::to_string(other_station) +
                     " answered a request to " + who +
                     "; expected each station number to belong to one controller");
    throw BoxError(silence_text(work_.port, who, tried, is_noisy, work_.photo.is_echoing));
  }

  /// Reads the order of words, which may be a setting of the controller.
  void find_word_order() {
    const std::string name(map_.policy().word_order_in);
    const auto place = name.empty() ? std::nullopt : map_.find(name, work_.model.firmwares.back());
    if (!place) return;
    const play::HostReply reply = ask(place->place.row->table, place->place.address(), 1, name);
    if (reply.kind == Kind::good) low_word_first_ = reply.words.front() == 1;
  }

  /// Sends a request, and repeats it if there is no answer or the controller is busy.
  play::HostReply ask(Table table, std::uint16_t first, int count, const std::string& name) {
    play::HostReply reply;
    for (int i = 0; i < kTries; ++i) {
      work_.report(name);
      ReadReply read = master_->read(table, first, count);
      reply = std::move(read.reply);
      work_.note(std::move(read.asked));
      const bool is_final =
          reply.kind == Kind::good || (reply.kind == Kind::exception && reply.exception != kBusy);
      if (is_final) break;
    }
    return reply;
  }

  /// Throws BoxError if the controller no longer answers what it has answered before.
  void require_contact() {
    if (!known_good_) return;
    const ReadBlock& block = *known_good_;
    const play::HostReply reply = ask(block.table, block.first(), block.count(), "is it still there?");
    if (reply.kind == Kind::good) return;
    throw BoxError(one_line(work_.port.place) + ": station " + std::to_string(station_) +
                   " stopped answering after " + std::to_string(work_.photo.exchanges.size()) +
                   " requests; expected a controller that stays on");
  }

  void read_block(const ReadBlock& block) {
    const ReadCell& first = block.cells.front();
    const play::HostReply reply =
        ask(block.table, block.first(), block.count(), map_.unique_name(*first.row, first.index));
    if (reply.kind == Kind::good) {
      known_good_ = block;
      for (const ReadCell& cell : block.cells) take_cell(block, cell, reply.words);
      return;
    }
    if (reply.kind != Kind::exception) require_contact();
    const bool is_hopeless = reply.kind == Kind::exception && reply.exception == kUnknownFunction;
    if (block.cells.size() == 1 || is_hopeless) {
      for (const ReadCell& cell : block.cells) refuse(block.table, cell, why_refused(reply));
      return;
    }
    const auto [lower, upper] = halves_of(block);
    read_block(lower);
    read_block(upper);
  }

  void refuse(Table table, const ReadCell& cell, const std::string& why) {
    work_.refuse({.name = map_.unique_name(*cell.row, cell.index),
                  .why = why,
                  .table = std::string(to_string(table)),
                  .address = cell.address});
  }

  void take_cell(const ReadBlock& block, const ReadCell& cell, const std::vector<std::uint16_t>& words) {
    const RegisterRow& row = *cell.row;
    const auto at = static_cast<std::size_t>(cell.address - block.first());
    const std::uint32_t bits = cell.size == 2 ? bits_of_wire(row, words[at], words[at + 1], low_word_first_)
                                              : std::uint32_t{wire_word(row, words[at])};
    const Value value = value_of(bits, row.type);
    std::string name = map_.unique_name(row, cell.index);
    if (!row.is_view && device_->register_bank()->keeps(row) && value != row.factory) {
      if (row.type == Type::f32 && std::isfinite(real_of(value))) {
        image_.reals.emplace_back(name, real_of(value));
      } else {
        image_.registers.emplace_back(name, value);
      }
    }
    work_.photo.values.push_back({.name = std::move(name),
                                  .value = value_text(value, row.type),
                                  .table = std::string(to_string(block.table)),
                                  .address = cell.address});
  }

  PhotoWork& work_;
  const RegisterMap& map_;
  std::vector<ReadBlock> plan_;
  std::unique_ptr<Device> device_;  // knows which values are persistent
  std::optional<ModbusMaster> master_;
  std::optional<ReadBlock> known_good_;  // the last block that was answered
  NvImage image_;
  bool low_word_first_ = true;
  int station_ = 1;
};

}  // namespace

void photograph_registers(PhotoWork& work) { RegisterPhoto(work).take(); }

}  // namespace understudy::emulator::box
