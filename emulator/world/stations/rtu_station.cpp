#include "emulator/world/stations/rtu_station.h"

#include <algorithm>
#include <stdexcept>

#include "emulator/device/modbus/modbus_station.h"
#include "emulator/world/stations/server.h"
#include "emulator/world/stations/station_fields.h"
#include "pty/rtu_crc.h"
#include "pty/state_reach.h"

namespace understudy::emulator::world {

namespace {

ModbusReply refusal(std::uint8_t function, int exception) {
  ModbusReply reply;
  reply.pdu[0] = function | 0x80;
  reply.pdu[1] = static_cast<std::uint8_t>(exception);
  reply.size = 2;
  return reply;
}

}  // namespace

std::optional<pty::SimTime> RtuStation::due() const {
  std::optional<pty::SimTime> due = framer_.due();
  if (is_early_) due = pty::SimTime{0};
  if (!late_.empty()) due = std::min(due.value_or(late_.front().at), late_.front().at);
  return due;
}

void RtuStation::run(pty::SimTime now, pty::Transmitter& out) {
  run_late(now, out);
  if (is_early_) {
    is_early_ = false;
    if (const auto frame = framer_.take_early()) take_frame(*frame, now, out);
  }
  while (const auto frame = framer_.take_due(now)) take_frame(*frame, now, out);
}

void RtuStation::reset() {
  framer_.reset();
  late_.clear();
  is_early_ = false;
}

void RtuStation::take_frame(const pty::RtuFrame& frame, pty::SimTime now, pty::Transmitter& out) {
  if (faults_ == nullptr) return serve_frame(frame, now, out);
  const auto bytes = std::span(frame.bytes).first(frame.size);
  const std::vector<pty::WireFault> stages = faults_->on_request(heard(bytes, frame.last_character, now));
  if (stages.empty()) return serve_frame(frame, now, out);
  for (pty::WirePiece& piece : pty::through_faults(bytes, stages)) {
    if (piece.late == pty::SimTime{0}) {
      serve_garbled(piece.bytes, frame.last_character, now, out);
    } else {
      keep_late({now + piece.late, false, frame.last_character, std::move(piece.bytes)});
    }
  }
}

void RtuStation::serve_frame(const pty::RtuFrame& frame, pty::SimTime now, pty::Transmitter& out) {
  const std::uint8_t address = frame.bytes[0];
  const Addressing addressing = device_.modbus()->addressing(address);
  if (addressing == Addressing::ignore) return;
  ++counters_.requests;
  const HeardFrame request = heard(std::span(frame.bytes).first(frame.size), frame.last_character, now);
  const FrameFaults::Treatment treatment =
      faults_ == nullptr ? FrameFaults::Treatment{} : faults_->on_serving(request);
  const ModbusReply reply = treatment.exception != 0
                                ? refusal(frame.bytes[1], treatment.exception)
                                : serve(device_, std::span(frame.bytes).subspan(1, frame.size - 3));
  if (addressing == Addressing::obey_silently || !treatment.is_answered) return;

  const bool refuses = (reply.pdu[0] & 0x80) != 0;
  if (refuses && treatment.exception == 0 && !device_.modbus()->answers_refusals()) return;

  ++counters_.replies;
  if (refuses) ++counters_.exceptions;
  std::array<std::uint8_t, pty::kRtuMaxFrame> buffer;
  buffer[0] = address;
  std::copy_n(reply.pdu.begin(), reply.size, buffer.begin() + 1);
  const auto bytes = std::span(buffer).first(pty::append_rtu_crc(buffer, reply.size + 1));
  const std::vector<pty::WireFault> stages =
      faults_ == nullptr ? std::vector<pty::WireFault>{} : faults_->on_reply(request);
  if (stages.empty()) return out.answer(bytes, frame.last_character);
  for (pty::WirePiece& piece : pty::through_faults(bytes, stages)) {
    if (piece.late == pty::SimTime{0}) {
      out.answer(piece.bytes, frame.last_character);
    } else {
      keep_late({now + piece.late, true, frame.last_character, std::move(piece.bytes)});
    }
  }
}

// --- faults --------------------------------------------------------------------------------------

HeardFrame RtuStation::heard(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                             pty::SimTime now) const {
  return {.device = device_number_,
          .bytes = bytes,
          .last_character = last_character,
          .is_for_device = device_.modbus()->addressing(bytes[0]) != Addressing::ignore,
          .now = now};
}

/// The frame that this character completes, if it does.
void RtuStation::look_for_early_frame(const pty::TimedByte& byte) {
  const auto frame = framer_.peek();
  if (!frame || frame->last_character != byte.number) return;
  const HeardFrame request = heard(std::span(frame->bytes).first(frame->size), byte.number, byte.end);
  is_early_ = is_early_ || (request.is_for_device && faults_->is_early(request));
}

/// What the wire has made of a request, judged as if it had come so.
void RtuStation::serve_garbled(const std::vector<std::uint8_t>& bytes, std::uint64_t last_character,
                               pty::SimTime now, pty::Transmitter& out) {
  constexpr pty::SimTime kInstant{1};
  pty::RtuFramer framer({.strict = framer_.framing().strict, .silence = kInstant, .patience = kInstant});
  for (const std::uint8_t value : bytes) {
    framer.push({.start = now, .end = now, .value = value, .number = last_character});
  }
  while (const auto frame = framer.take(now + kInstant)) serve_frame(*frame, now, out);
}

void RtuStation::keep_late(Late message) {
  if (late_.size() == kMostLate) return;
  const auto place = std::upper_bound(late_.begin(), late_.end(), message.at,
                                      [](pty::SimTime at, const Late& other) { return at < other.at; });
  late_.insert(place, std::move(message));
}

void RtuStation::run_late(pty::SimTime now, pty::Transmitter& out) {
  while (!late_.empty() && late_.front().at <= now) {
    const Late message = std::move(late_.front());
    late_.erase(late_.begin());
    if (message.is_reply) {
      out.answer(message.bytes, message.last_character);
    } else {
      serve_garbled(message.bytes, message.last_character, now, out);
    }
  }
}

// --- its state -----------------------------------------------------------------------------------

RtuStation::State RtuStation::save() const {
  return {.framer = framer_.save(), .counters = counters_, .late = late_};
}

void RtuStation::check(const State& state) const {
  framer_.check(state.framer);
  const auto demand = [](bool holds) {
    if (!holds) throw std::invalid_argument("a station cannot hold such late messages");
  };
  demand(state.late.size() <= kMostLate);
  pty::SimTime before{0};
  for (const Late& message : state.late) {
    demand(message.at >= before && pty::is_within_reach(message.at) && !message.bytes.empty());
    before = message.at;
  }
}

void RtuStation::restore(const State& state) {
  framer_.restore(state.framer);
  counters_ = state.counters;
  late_ = state.late;
}

void RtuStation::write_state(StateWriter& writer) const { writer.write(save()); }

std::function<void()> RtuStation::read_state(StateReader& reader) { return read_state_of(*this, reader); }

std::string RtuStation::difference(StateReader& a, StateReader& b, const std::string& path) const {
  return difference_of_saved<State>(a, b, path);
}

}  // namespace understudy::emulator::world
