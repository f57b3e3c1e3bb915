#include "emulator/device/device.h"

#include "base/prefetch.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"

namespace understudy::emulator {

Device::Device(const Model& model, DeviceSettings settings)
    : model_(model),
      choices_(resolve_choices(model.choices, settings.choices)),
      inputs_(model.terminals.size(), 0),
      settings_(std::move(settings)),
      mentioned_(model.registers.rows().size(), false) {}

void Device::prefetch(Tick /*tick*/) const {
  // Of the device itself the beginning; its settings are large, and no tick reads them.
  prefetch_line(this);
  if (inputs_changed_) understudy::prefetch(inputs_.data(), inputs_.size() * sizeof inputs_[0]);
}

void Device::switch_power(bool on) {
  if (on == powered_) return;
  powered_ = on;
  inputs_changed_ = true;
  if (on) {
    power_up();
  } else {
    power_down();
  }
}

std::optional<std::string> Device::assign(std::string_view /*name*/, double /*value*/) {
  return "cannot be set; expected a name of the device";
}

std::string Device::why_no_value(std::string_view name) const {
  return "nothing of " + settings_.name + " is called " + quoted(name) + suggestion(name, names());
}

NvImage Device::nv_image() const {
  NvImage image{.model = std::string(model_.name), .firmware = version_text(firmware())};
  write_memory(image);
  return image;
}

void Device::load_nv(const NvImage& image) {
  if (image.model != model_.name) {
    throw NvError("model: is the memory of a " + quoted(image.model) + "; expected one of " +
                  std::string(model_.name));
  }
  read_memory(image);
}

void Device::write_memory(NvImage& image) const {
  const std::span<const std::uint32_t> kept = kept_image();
  std::size_t slot = 0;
  for (const RegisterRow& row : registers().rows()) {
    for (int i = 0; i < row.count; ++i, ++slot) {
      if (!keeps(row) || kept[slot] == static_cast<std::uint32_t>(row.factory)) continue;
      image.registers.emplace_back(RegisterMap::name_of(row, i), value_of(kept[slot], row.type));
    }
  }
}

void Device::read_memory(const NvImage& image) {
  for (const auto& [key, is_there] :
       {std::pair("reals", !image.reals.empty()), std::pair("program", !image.program.empty())}) {
    if (!is_there) continue;
    throw NvError(std::string(key) + ": is not part of the memory of " + std::string(model_.name) +
                  "; expected none");
  }
  std::vector<std::pair<std::size_t, std::uint32_t>> wanted;
  for (const auto& [name, value] : image.registers) {
    // Of any firmware: an update leaves the memory as it is.
    const auto found = registers().find(name, model_.firmwares.back());
    if (!found || found->bit >= 0 || found->place.part != Place::Part::whole) {
      throw NvError("registers: " + registers().why_not(name, model_.firmwares.back()));
    }
    const RegisterRow& row = *found->place.row;
    if (!keeps(row)) {
      throw NvError("registers: " + quoted(name) + " is not kept over power-off; expected one that is");
    }
    const auto bits = static_cast<std::uint32_t>(value);
    // Half of a 32-bit value may have been written alone, so it can be beyond its range; nothing else can.
    const bool in_range = !row.ranged || is_32_bit(row.type) || (value >= row.min && value <= row.max);
    if (value_of(bits, row.type) != value || (bits & row.stored_bits) != bits || !in_range) {
      throw NvError("registers: " + quoted(name) + ": " + std::to_string(value) + " does not fit; expected " +
                    range_text(row));
    }
    for (const auto& [slot, other_bits] : wanted) {
      if (slot == static_cast<std::size_t>(found->place.slot)) {
        throw NvError("registers: " + quoted(name) + ": is there twice, by two names; expected it once");
      }
    }
    wanted.emplace_back(static_cast<std::size_t>(found->place.slot), bits);
  }
  std::size_t slot = 0;
  for (const RegisterRow& row : registers().rows()) {
    for (int i = 0; i < row.count; ++i, ++slot) put_kept(slot, static_cast<std::uint32_t>(row.factory));
  }
  for (const auto& [place, bits] : wanted) put_kept(place, bits);
}

void Device::load_program(std::string_view) {
  throw ProgramError(0, std::string(model_.name) + " takes no program from a file; expected none");
}

void Device::mention_unmodelled(const RegisterRow& row) const {
  const auto number = static_cast<std::size_t>(&row - registers().rows().data());
  if (mentioned_[number] || !log_) return;
  mentioned_[number] = true;
  log_(name() + ": " + std::string(row.name) + " is not modelled: " + std::string(row.unmodelled));
}

void Device::mention_unmodelled(std::string_view what, std::string_view why) const {
  if (!log_ || !mentioned_names_.emplace(what).second) return;
  log_(name() + ": " + std::string(what) + " is not modelled: " + std::string(why));
}

std::string range_text(const RegisterRow& row) {
  if (row.stored_bits < 0xFFFF) return "0 to " + std::to_string(row.stored_bits);
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
