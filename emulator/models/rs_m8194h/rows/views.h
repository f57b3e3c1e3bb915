// RS-M8194H: readers and writers of its registers (registers.h refers to them).
#pragma once

#include <cstdint>
#include <span>

#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator::models::rs_m8194h {

class Module;

// --- FRnet: words by Cell::index, bits of the group in the row's argument
Value do_word(const Module& it, Cell cell);
Value di_word(const Module& it, Cell cell);
Value do_bit(const Module& it, Cell cell);
Value di_bit(const Module& it, Cell cell);
void write_do_word(Module& it, Cell cell, Value value);
void write_do_bit(Module& it, Cell cell, Value value);

// --- for each axis; the row's argument selects a single bit
Value di_all(const Module& it, Cell cell);
Value di_all_bit(const Module& it, Cell cell);
Value error_code(const Module& it, Cell cell);
Value error_bit(const Module& it, Cell cell);
Value di_signal(const Module& it, Cell cell);
Value di_signal_bit(const Module& it, Cell cell);
Value logic_position(const Module& it, Cell cell);
Value encoder_position(const Module& it, Cell cell);
Value absolute_position(const Module& it, Cell cell);
Value current_velocity(const Module& it, Cell cell);
Value current_acceleration(const Module& it, Cell cell);
Value stop_status(const Module& it, Cell cell);
Value latch(const Module& it, Cell cell);
Value home_state(const Module& it, Cell cell);
Value servo_is_on(const Module& it, Cell cell);
void queue_logic_position(Module& it, Cell cell, Value value);
void queue_encoder_position(Module& it, Cell cell, Value value);
void queue_absolute_position(Module& it, Cell cell, Value value);

// --- for the whole controller
Value running_mp(const Module& it, Cell cell);
Value emergency_state(const Module& it, Cell cell);
Value error_state(const Module& it, Cell cell);
Value free_blocks(const Module& it, Cell cell);
Value rint_word(const Module& it, Cell cell);
Value rint_bit(const Module& it, Cell cell);
Value module_id(const Module& it, Cell cell);
Value rsm_firmware(const Module& it, Cell cell);
Value module_firmware(const Module& it, Cell cell);
Value interpolation_ready(const Module& it, Cell cell);
Value driving_axes(const Module& it, Cell cell);
Value rsm_state(const Module& it, Cell cell);
Value module_state(const Module& it, Cell cell);
Value illegal_reason(const Module& it, Cell cell);
Value download_field(const Module& it, Cell cell);   // the row's argument selects one of five fields
Value execution_field(const Module& it, Cell cell);  // the row's argument selects one of five fields
Value factor_axes(const Module& it, Cell cell);      // the row's argument selects the factor
Value call_register(const Module& it, Cell cell);
void call_mp(Module& it, Cell cell, Value value);
void enable_triggers(Module& it, Cell cell, Value value);
DeviceAnswer take_message(Module& it, Cell cell, std::span<const std::uint16_t> words);

}  // namespace understudy::emulator::models::rs_m8194h
