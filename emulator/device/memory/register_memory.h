// Converts between persistent registers and the image of a memory.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "emulator/device/memory/nv_image.h"
#include "emulator/device/register_map/register_bank.h"

namespace understudy::emulator {

/// Throws StateError unless each register of a restored image, and of the stored values, has a value that a
/// write or a memory image may give it.
void check_restored_registers(const RegisterBank& bank, std::span<const std::uint32_t> image,
                              std::span<const std::uint32_t> content);

/// Returns a function that adds the stored registers that differ from the factory values to an image.
/// `content` has one value for each slot; those of registers that are not persistent are ignored. Only the
/// map of `bank` must outlive the function.
std::function<void(NvImage&)> registers_writer(const RegisterBank& bank,
                                               std::span<const std::uint32_t> content);

/// Returns one value for each slot. Registers that the image does not name get the factory value. `newest`
/// is the model's newest firmware: an update leaves the memory as it is, so it may hold registers of any
/// version. Throws NvError for entries that such a memory cannot have.
std::vector<std::uint32_t> read_registers(const RegisterBank& bank, const NvImage& image, Firmware newest);

}  // namespace understudy::emulator
