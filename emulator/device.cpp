#include "emulator/device.h"

namespace understudy::emulator {

Device::Device(const Model& model, DeviceSettings settings)
    : model_(model),
      settings_(std::move(settings)),
      choices_(resolve_choices(model.choices, settings_.choices)),
      inputs_(model.terminals.size(), false),
      mentioned_(model.registers.rows().size(), false) {}

void Device::mention_unmodelled(const RegisterRow& row) const {
  const auto number = static_cast<std::size_t>(&row - registers().rows().data());
  if (mentioned_[number] || !log_) return;
  mentioned_[number] = true;
  log_(name() + ": " + std::string(row.name) + " is not modelled: " + std::string(row.unmodelled));
}

std::string range_text(const RegisterRow& row) {
  if (row.ranged) return std::to_string(row.min) + " to " + std::to_string(row.max);
  switch (row.type) {
    case Type::u16: return "0 to 65535";
    case Type::s16: return "-32768 to 32767";
    case Type::u32: return "0 to 4294967295";
    case Type::s32: return "-2147483648 to 2147483647";
  }
  return "";
}

}  // namespace understudy::emulator
