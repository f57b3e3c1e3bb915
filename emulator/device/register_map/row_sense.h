// Checks that a row of a register map is consistent in itself.
#pragma once

#include "emulator/device/register_map/row.h"

namespace understudy::emulator {

/// Throws std::logic_error, which contains the row's name and what is wrong with the row.
void validate_rows(const RegisterRow& row);

}  // namespace understudy::emulator
