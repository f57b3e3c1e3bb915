// The base of a device class `Itself`. Each function that returns a facet returns the device if its class
// derives from the facet, and null otherwise. A device that contains a facet as a member overrides the
// function of that facet.
#pragma once

#include <type_traits>

#include "emulator/device/device.h"

namespace understudy::emulator {

template <typename Itself>
class DeviceOf : public Device {
 public:
  using Device::Device;

  RegisterBank* register_bank() override { return facet<RegisterBank>(*this); }
  const RegisterBank* register_bank() const override { return facet<const RegisterBank>(*this); }
  ModbusStation* modbus() override { return facet<ModbusStation>(*this); }
  const ModbusStation* modbus() const override { return facet<const ModbusStation>(*this); }
  TextProtocol* text_protocol() override { return facet<TextProtocol>(*this); }
  const TextProtocol* text_protocol() const override { return facet<const TextProtocol>(*this); }
  NamedValues* named_values() override { return facet<NamedValues>(*this); }
  const NamedValues* named_values() const override { return facet<const NamedValues>(*this); }
  PersistentMemory* memory() override { return facet<PersistentMemory>(*this); }
  const PersistentMemory* memory() const override { return facet<const PersistentMemory>(*this); }
  UserProgram* user_program() override { return facet<UserProgram>(*this); }
  const UserProgram* user_program() const override { return facet<const UserProgram>(*this); }
  const Terminals* terminals() const override { return facet<const Terminals>(*this); }
  Axes* axes() override { return facet<Axes>(*this); }
  const Axes* axes() const override { return facet<const Axes>(*this); }

 private:
  template <typename Facet, typename Self>
  static Facet* facet(Self& self) {
    if constexpr (std::is_base_of_v<Facet, Itself>) {
      return &static_cast<std::conditional_t<std::is_const_v<Self>, const Itself, Itself>&>(self);
    } else {
      return nullptr;
    }
  }
};

}  // namespace understudy::emulator
