// A device's registers, for everything that reads and writes them (access.h): the wire, the control socket,
// scenarios, the device's own program. A facet: Device::register_bank() is null where a device has none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator {

/// A request for consecutive registers or bits that the map has found good.
struct RegisterRequest {
  Table table = Table::holding;
  std::uint16_t first = 0;
  std::size_t count = 0;
  std::span<const std::uint16_t> words{};  // that it writes, a bit each in tables of bits; none: it reads
  bool is_single = false;                  // by a function that writes one register or bit
  bool is_write() const { return !words.empty(); }
};

/// How much of a request has been found good. A write is shown twice, a read once.
enum class Checked : std::uint8_t { addresses, everything };

class RegisterBank {
 public:
  const RegisterMap& map() const { return map_; }
  /// What the device has at an address, or by a name, in its firmware.
  Place at(Table table, std::uint16_t address) const {
    return map_.at(table, address, map_firmware_, low_word_first());
  }
  /// The same for many: `low_word_first` as the device has it at this moment.
  Place at(Table table, std::uint16_t address, bool low_word_first_now) const {
    return map_.at(table, address, map_firmware_, low_word_first_now);
  }
  std::optional<NamedPlace> find(std::string_view name) const { return map_.find(name, map_firmware_); }
  /// Why find() found nothing, as one line.
  std::string why_not(std::string_view name) const { return map_.why_not(name, map_firmware_); }
  bool has_row(const RegisterRow& row) const { return map_firmware_ >= row.since; }

  /// The map's answer, or this device's own.
  virtual const MapPolicy& map_policy() const { return map_.policy(); }
  virtual bool low_word_first() const { return map_.policy().low_word_first; }
  /// One slot for each register, as the map numbers them.
  virtual std::span<std::uint32_t> image() = 0;
  virtual std::span<const std::uint32_t> image() const = 0;
  /// Whether a register survives power-off.
  virtual bool keeps(const RegisterRow& row) const { return row.persistent; }

  /// Whether the device takes a request that is good so far: it may be busy, or fail. Asked before anything
  /// is stored, of requests from outside; it is not asked about what it writes itself.
  virtual DeviceAnswer admits(const RegisterRequest& /*request*/, Checked /*checked*/) const {
    return Refusal::none;
  }
  /// Whether a write is one message to the device although it begins in no window (see row.h). Asked before
  /// what it writes is looked up, so registers that can only be read may be among it.
  virtual bool takes_whole(const RegisterRequest& /*request*/) const { return false; }
  /// Takes it, once admits() has; or refuses it, and has changed nothing.
  virtual DeviceAnswer take_whole(const RegisterRequest& /*request*/) { return Refusal::none; }
  /// Whether a message may also begin behind its window's first word: the device keeps such a part.
  virtual bool takes_parts() const { return false; }
  /// Asked of each register of a good write before anything is stored, in ascending order: whether the device
  /// makes something else of it. Then it is not stored, and has no effect.
  virtual bool diverts(const Place& /*place*/, std::uint32_t /*bits*/) { return false; }
  /// Its station has answered a request that reads: what was to be read once is gone now.
  virtual void read_answered(const RegisterRequest& /*request*/) {}
  /// Its station has answered a request with an exception.
  virtual void exception_answered(const RefusedRequest& /*request*/) {}

  /// Called for each register of the image that a request has written, after its effect.
  virtual void register_written(const RegisterRow& row, std::size_t slot) = 0;
  /// Called after a write request has been stored and all its effects have run.
  virtual void registers_written() {}
  /// Tells the user, once for each row, that something is not modelled.
  virtual void mention_unmodelled(const RegisterRow& row) const = 0;

 protected:
  RegisterBank(const RegisterMap& map, Firmware firmware) : map_(map), map_firmware_(firmware) {}
  ~RegisterBank() = default;

 private:
  const RegisterMap& map_;
  Firmware map_firmware_;
};

/// The registers of a device of type `D`: rows whose functions take that type find it here (row.h).
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
