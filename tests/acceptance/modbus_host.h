// A host that uses libmodbus, like many real programs; and the registers of a Simple2-R3 that tests use.
#pragma once

#include <errno.h>
#include <modbus/modbus-rtu.h>
#include <modbus/modbus.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace understudy::acceptance {

inline constexpr int kStatus = 0x0000;
inline constexpr int kHardwareCode = 0x0001;
inline constexpr int kHole = 0x0003;
inline constexpr int kCordA = 0x0E04;
inline constexpr int kAaxisPulse = 0x1000;
inline constexpr int kAaxisSpeed = 0x1002;
inline constexpr int kAaxisAccTime = 0x1003;
inline constexpr int kAaxisMoveInc = 0x1005;
inline constexpr int kAaxisSvon = 0x1014;
inline constexpr int kMovingA = 1 << 4;  // a bit of STATUS

struct HostSetup {
  int baud = 19200;
  char parity = 'E';
  int station = 1;
  std::chrono::milliseconds patience{10'000};  // any reply arrives before this, however busy the machine is

  friend std::ostream& operator<<(std::ostream& out, const HostSetup& setup) {
    return out << setup.baud << " 8" << setup.parity << "1";
  }
};

using Registers = std::vector<std::uint16_t>;
using Bits = std::vector<std::uint8_t>;  // 0 or 1 each

/// A connected libmodbus context. A failure returns no registers or false, and leaves its errno in error().
class ModbusHost {
 public:
  explicit ModbusHost(const std::string& port, const HostSetup& setup = {})
      : context_(modbus_new_rtu(port.c_str(), setup.baud, setup.parity, 8, 1)), patience_(setup.patience) {
    set_station(setup.station);
    set_patience(setup.patience);
    connected_ = note(modbus_connect(context_.get())) == 0;
  }

  /// Sends a request that gets no reply, and therefore does not wait long.
  template <class Ask>
  auto in_vain(const Ask& ask, std::chrono::milliseconds patience = std::chrono::milliseconds(200)) {
    set_patience(patience);
    auto got = ask(*this);
    const int error = error_;
    set_patience(patience_);
    error_ = error;
    return got;
  }

  bool connected() const { return connected_; }
  int error() const { return error_; }
  void set_station(int station) { modbus_set_slave(context_.get(), station); }
  void set_patience(std::chrono::milliseconds patience) {
    const auto microseconds = static_cast<std::uint32_t>(patience.count() * 1000);
    modbus_set_response_timeout(context_.get(), microseconds / 1'000'000, microseconds % 1'000'000);
  }

  Registers read(int address, int count = 1) { return read_with(modbus_read_registers, address, count); }
  Registers read_input(int address, int count = 1) {
    return read_with(modbus_read_input_registers, address, count);
  }
  /// Reads coils or discrete inputs.
  Bits read_coils(int address, int count = 1) { return read_bits_with(modbus_read_bits, address, count); }
  Bits read_inputs(int address, int count = 1) {
    return read_bits_with(modbus_read_input_bits, address, count);
  }
  bool write_coils(int address, const Bits& bits) {
    const int count = static_cast<int>(bits.size());
    return note(modbus_write_bits(context_.get(), address, count, bits.data())) == count;
  }
  bool write(int address, int value) {
    return note(modbus_write_register(context_.get(), address, static_cast<std::uint16_t>(value))) == 1;
  }
  bool write(int address, const Registers& values) {
    const int count = static_cast<int>(values.size());
    return note(modbus_write_registers(context_.get(), address, count, values.data())) == count;
  }
  bool write_bit(int address, bool on) {
    return note(modbus_write_bit(context_.get(), address, on ? 1 : 0)) == 1;
  }
  /// Sends any request (station, function, data; the checksum is added). Returns true if the reply is not an
  /// exception; error() tells which one it is.
  bool request(std::vector<std::uint8_t> bytes) {
    if (note(modbus_send_raw_request(context_.get(), bytes.data(), static_cast<int>(bytes.size()))) < 0)
      return false;
    std::array<std::uint8_t, MODBUS_RTU_MAX_ADU_LENGTH> reply{};
    if (note(modbus_receive_confirmation(context_.get(), reply.data())) < 0) return false;
    if ((reply[1] & 0x80) != 0) error_ = MODBUS_ENOBASE + reply[2];
    return error_ == 0;
  }

  /// Reads 32 bits, low word first, as a Simple2-R3 stores them.
  std::int32_t read_long(int address) {
    const Registers words = read(address, 2);
    if (words.size() != 2) throw std::runtime_error(std::string("no reply: ") + modbus_strerror(error_));
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(words[1]) << 16 | words[0]);
  }
  bool is_moving() {
    const Registers status = read(kStatus);
    if (status.empty()) throw std::runtime_error(std::string("no reply: ") + modbus_strerror(error_));
    return (status[0] & kMovingA) != 0;
  }

 private:
  struct Close {
    void operator()(modbus_t* context) const {
      modbus_close(context);
      modbus_free(context);
    }
  };

  int note(int result) {
    error_ = result < 0 ? errno : 0;
    return result;
  }
  Registers read_with(int (*function)(modbus_t*, int, int, std::uint16_t*), int address, int count) {
    Registers values(static_cast<std::size_t>(count));
    if (note(function(context_.get(), address, count, values.data())) != count) values.clear();
    return values;
  }

  Bits read_bits_with(int (*function)(modbus_t*, int, int, std::uint8_t*), int address, int count) {
    Bits values(static_cast<std::size_t>(count));
    if (note(function(context_.get(), address, count, values.data())) != count) values.clear();
    return values;
  }

  std::unique_ptr<modbus_t, Close> context_;
  std::chrono::milliseconds patience_;
  bool connected_ = false;
  int error_ = 0;
};

}  // namespace understudy::acceptance
