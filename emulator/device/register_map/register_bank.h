// A device's registers, for all code that reads and writes them (access.h): the line, the control socket,
// scenarios, and the device's own program. This is a facet: Device::register_bank() is null if a device has
// no registers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator {

/// A request for consecutive registers or bits that the map has accepted.
struct RegisterRequest {
  Table table = Table::holding;
  std::uint16_t first = 0;
  std::size_t count = 0;
  std::span<const std::uint16_t>
      words{};             // the words to write, or one bit per word in tables of bits; empty for a read
  bool is_single = false;  // the function writes a single register or bit
  bool is_write() const { return !words.empty(); }
};

/// How much of a request has been checked. The device is asked twice about a write, and once about a read.
enum class Checked : std::uint8_t { addresses, everything };

class RegisterBank {
 public:
  const RegisterMap& map() const { return map_; }
  /// Returns the place at an address, in the device's firmware. find() does the same for a name.
  Place at(Table table, std::uint16_t address) const {
    return map_.at(table, address, map_firmware_, low_word_first());
  }
  /// The same, for many addresses. `low_word_first_now` is the device's present word order.
  Place at(Table table, std::uint16_t address, bool low_word_first_now) const {
    return map_.at(table, address, map_firmware_, low_word_first_now);
  }
  std::optional<NamedPlace> find(std::string_view name) const { return map_.find(name, map_firmware_); }
  /// Returns a one-line explanation of why find() found nothing.
  std::string why_not(std::string_view name) const { return map_.why_not(name, map_firmware_); }
  bool has_row(const RegisterRow& row) const { return map_firmware_ >= row.since; }

  /// Returns this device's policy, which by default is the map's.
  virtual const MapPolicy& map_policy() const { return map_.policy(); }
  virtual bool low_word_first() const { return map_.policy().low_word_first; }
  /// Returns the register image: one slot for each register, as the map numbers them.
  virtual std::span<std::uint32_t> image() = 0;
  virtual std::span<const std::uint32_t> image() const = 0;
  /// Returns true if a register survives power-off.
  virtual bool keeps(const RegisterRow& row) const { return row.persistent; }

  /// Returns whether the device accepts a request that has passed all checks so far, or is busy or fails.
  /// Called before anything is stored, for requests from outside but not for the device's own writes.
  virtual DeviceAnswer admits(const RegisterRequest& /*request*/, Checked /*checked*/) const {
    return Refusal::none;
  }
  /// Returns true if the device handles a write as one message although it does not begin in a window (see
  /// row.h). Called before the registers are looked up, so they may include read-only registers.
  virtual bool takes_whole(const RegisterRequest& /*request*/) const { return false; }
  /// Called after admits() has accepted the message. Executes it, or refuses it without changing anything.
  virtual DeviceAnswer take_whole(const RegisterRequest& /*request*/) { return Refusal::none; }
  /// Returns true if the device accepts parts of messages, so that a message can begin after the first word
  /// of its window.
  virtual bool takes_parts() const { return false; }
  /// Called for each register of a valid write in ascending order, before anything is stored. If it returns
  /// true, the device has used the value in its own way, so the value is not stored and has no effect.
  virtual bool diverts(const Place& /*place*/, std::uint32_t /*bits*/) { return false; }
  /// Called when the station has answered a read request. Clears registers that can only be read once.
  virtual void read_answered(const RegisterRequest& /*request*/) {}
  /// Called when the station has answered a request with an exception.
  virtual void exception_answered(const RefusedRequest& /*request*/) {}

  /// Called for each register of the image that a request has written, after its effect.
  virtual void register_written(const RegisterRow& row, std::size_t slot) = 0;
  /// Called after a write request has been stored and all of its effects have been applied.
  virtual void registers_written() {}
  /// Warns the user, once for each row, that it is not modelled.
  virtual void warn_not_implemented(const RegisterRow& row) const = 0;

 protected:
  RegisterBank(const RegisterMap& map, Firmware firmware) : map_(map), map_firmware_(firmware) {}
  ~RegisterBank() = default;

 private:
  const RegisterMap& map_;
  Firmware map_firmware_;
};

/// The registers of a device of type `D`. Row functions that have a `D` parameter receive this device
/// (row.h).
template <typename D>
class RegisterBankOf : public RegisterBank {
 public:
  D& device() { return device_; }
  const D& device() const { return device_; }

 protected:
  RegisterBankOf(D& device, const RegisterMap& map, Firmware firmware)
      : RegisterBank(map, firmware), device_(device) {}
  ~RegisterBankOf() = default;

 private:
  D& device_;
};

}  // namespace understudy::emulator
