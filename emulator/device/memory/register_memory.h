// Registers that survive power-off, as the image of a memory has them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "emulator/device/memory/nv_image.h"
#include "emulator/device/register_map/register_bank.h"

namespace understudy::emulator {

/// Throws StateError unless each register of a restored image, and of what is kept, holds what it may: the
/// same that a write, or an image of a memory, may bring there.
void check_restored_registers(const RegisterBank& bank, std::span<const std::uint32_t> image,
                              std::span<const std::uint32_t> kept);

/// What adds the registers that are kept now and differ from the factory's values. `kept` has one value for
/// each slot; those of registers that are not kept mean nothing. Of `bank` only the map must outlive it.
std::function<void(NvImage&)> registers_writer(const RegisterBank& bank, std::span<const std::uint32_t> kept);

/// The reverse, one value for each slot: what the image does not name has the factory's value. `newest` is
/// the model's newest firmware: an update leaves the memory as it is, so it may hold registers of any. Throws
/// NvError for what is not in such a memory.
std::vector<std::uint32_t> read_registers(const RegisterBank& bank, const NvImage& image, Firmware newest);

}  // namespace understudy::emulator
