#include "emulator/modbus/rtu_station.h"

#include <algorithm>

#include "emulator/modbus/server.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator {

void RtuStation::run(pty::SimTime now, pty::Transmitter& out) {
  while (framer_.due().value_or(pty::SimTime::max()) <= now) {
    if (const auto frame = framer_.take(now)) serve_frame(*frame, out);
  }
}

RtuStation::State RtuStation::save() const {
  const auto& [device, framer, counters] = *this;
  return {.framer = framer.save(), .counters = counters};
}

void RtuStation::restore(const State& state) {
  framer_.restore(state.framer);
  counters_ = state.counters;
}

void RtuStation::serve_frame(const pty::RtuFrame& frame, pty::Transmitter& out) {
  const std::uint8_t address = frame.bytes[0];
  const Addressing addressing = device_.addressing(address);
  if (addressing == Addressing::ignore) return;
  ++counters_.requests;
  const ModbusReply reply = serve(device_, std::span(frame.bytes).subspan(1, frame.size - 3));
  if (addressing == Addressing::obey_silently) return;

  ++counters_.replies;
  if ((reply.pdu[0] & 0x80) != 0) ++counters_.exceptions;
  std::array<std::uint8_t, pty::kRtuMaxFrame> bytes;
  bytes[0] = address;
  std::copy_n(reply.pdu.begin(), reply.size, bytes.begin() + 1);
  const std::size_t size = pty::append_rtu_crc(bytes, reply.size + 1);
  out.answer(std::span(bytes).first(size), frame.last_character);
}

}  // namespace understudy::emulator
