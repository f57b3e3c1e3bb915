// Converts between persistent registers and a memory image.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "emulator/device/memory/nv_image.h"
#include "emulator/device/register_map/register_bank.h"

namespace understudy::emulator {

/// Throws StateError unless each register in a restored image and in the stored values has a value that a
/// write or a memory image can assign.
void check_restored_registers(const RegisterBank& bank, std::span<const std::uint32_t> image,
                              std::span<const std::uint32_t> content);

/// Returns a function that adds the stored registers to an image if they differ from their factory values.
/// `content` has one value per slot; the values of registers that are not persistent are ignored. Only the
/// map of `bank` must outlive the function.
std::function<void(NvImage&)> registers_writer(const RegisterBank& bank,
                                               std::span<const std::uint32_t> content);

/// Returns one value per slot. Registers that are missing from the image get their factory values. `newest`
/// is the model's newest firmware: an update does not change the memory, so the memory may contain registers
/// of any version. Throws NvError for entries that such a memory cannot have.
std::vector<std::uint32_t> read_registers(const RegisterBank& bank, const NvImage& image, Firmware newest);

}  // namespace understudy::emulator
