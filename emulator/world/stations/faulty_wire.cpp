#include "emulator/world/stations/faulty_wire.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "emulator/world/stations/frame_faults.h"
#include "pty/state_reach.h"
#include "pty/station.h"
#include "pty/wire_fault.h"

namespace understudy::emulator::world {

void FaultyWire::check_completed(const ReceivedFrame& frame) {
  if (is_early_ || faults_ == nullptr || !frame.is_for_device) return;
  is_early_ = faults_->is_early(stamped(frame));
}

bool FaultyWire::take_early_frame() { return std::exchange(is_early_, false); }

bool FaultyWire::passes(const ReceivedFrame& request, pty::Transmitter& out) {
  if (faults_ == nullptr) return true;
  const std::vector<pty::WireFault> stages = faults_->on_request(stamped(request));
  if (stages.empty()) return true;
  for (pty::WirePiece& piece : pty::through_faults(request.bytes, stages)) {
    if (piece.late == pty::SimTime{0}) {
      end_.serve_piece(piece.bytes, request.last_character, request.now, out);
    } else {
      keep({request.now + piece.late, false, request.last_character, std::move(piece.bytes)});
    }
  }
  return false;
}

FrameFaults::Treatment FaultyWire::treatment_of(const ReceivedFrame& request) {
  return faults_ == nullptr ? FrameFaults::Treatment{} : faults_->on_serving(stamped(request));
}

void FaultyWire::answer(const ReceivedFrame& request, std::span<const std::uint8_t> bytes,
                        pty::Transmitter& out, pty::SimTime delay) {
  const auto send = [&](std::span<const std::uint8_t> piece, pty::SimTime late) {
    if (late == pty::SimTime{0}) return end_.transmit(piece, request.last_character, out);
    keep({request.now + late, true, request.last_character, {piece.begin(), piece.end()}});
  };
  if (faults_ == nullptr) return send(bytes, delay);
  const std::vector<pty::WireFault> stages = faults_->on_reply(stamped(request));
  if (stages.empty()) return send(bytes, delay);
  for (const pty::WirePiece& piece : pty::through_faults(bytes, stages))
    send(piece.bytes, piece.late + delay);
}

std::optional<pty::SimTime> FaultyWire::due() const {
  if (is_early_) return pty::SimTime{0};
  if (late_.empty()) return std::nullopt;
  return late_.front().at;
}

void FaultyWire::run(pty::SimTime now, pty::Transmitter& out) {
  while (!late_.empty() && late_.front().at <= now) {
    const Late message = std::move(late_.front());
    late_.erase(late_.begin());
    if (message.is_reply) {
      end_.transmit(message.bytes, message.last_character, out);
    } else {
      end_.serve_piece(message.bytes, message.last_character, now, out);
    }
  }
}

void FaultyWire::reset() {
  late_.clear();
  is_early_ = false;
}

void FaultyWire::keep(Late message) {
  if (late_.size() == kMaxLate) return;
  const auto place = std::upper_bound(late_.begin(), late_.end(), message.at,
                                      [](pty::SimTime at, const Late& other) { return at < other.at; });
  late_.insert(place, std::move(message));
}

void FaultyWire::check(const std::vector<Late>& late) {
  const auto require = [](bool holds) {
    if (!holds) throw std::invalid_argument("a station cannot hold messages back this long");
  };
  require(late.size() <= kMaxLate);
  pty::SimTime before{0};
  for (const Late& message : late) {
    require(message.at >= before && pty::is_within_reach(message.at) && !message.bytes.empty());
    before = message.at;
  }
}

}  // namespace understudy::emulator::world
