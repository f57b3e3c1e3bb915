// Sends a request to a real controller on Modbus and takes its reply, with the checksum of RTU or in the
// frame of Modbus TCP. It does not interpret the request.
#pragma once

#include <cstdint>
#include <functional>

#include "emulator/box/asking/asked.h"
#include "emulator/box/wire/wire.h"

namespace understudy::emulator::box {

class ModbusExchange {
 public:
  struct Settings {
    int station = 1;
    WallTime timeout{0};
    WallTime silence{0};                // before each request
    bool is_tcp = false;                // Modbus TCP: a header instead of a checksum
    std::function<void()> heartbeat{};  // called again and again while it waits for a reply; may throw
  };
  ModbusExchange(Wire& wire, const Settings& settings) : wire_(wire), settings_(settings) {}

  /// Both the request and the reply have a checksum.
  Asked ask(const Bytes& request);
  /// Waits for the silence that must come before a request, and drops what arrives meanwhile.
  void keep_silence();
  /// Others have used the line until now. `is_unsettled`: more bytes of theirs may arrive.
  void note_traffic(bool is_unsettled);

 private:
  Bytes ask_rtu(const Bytes& request, Asked& asked);
  Bytes ask_tcp(const Bytes& request, Asked& asked);

  bool receive(Bytes& bytes, WallTime deadline);

  Wire& wire_;
  Settings settings_;
  WallTime quiet_since_{0};
  bool is_unsettled_ = false;  // the rest of an unexpected reply may still arrive
  std::uint16_t transaction_ = 0;
  bool is_echoing_ = false;  // the adapter sends back what it is given, as an answer to a read has shown
};

}  // namespace understudy::emulator::box
