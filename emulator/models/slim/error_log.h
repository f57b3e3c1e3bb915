// Records the errors of each module, for ?ERR and ?ERC.
#pragma once

#include <array>
#include <string>

#include "emulator/device/memory/nv_image.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"

namespace understudy::emulator::models::slim {

void note_error(State& state, const Setup& setup, int module, Error error);
/// Records an error of a command for `module`. Returns the module to which the error is assigned.
int remember_error(State& state, const Setup& setup, int module, Error error);
/// Records the errors of queued commands that were dropped when they reached the head.
void remember_late_errors(State& state, const Setup& setup);

/// Returns the answer to ?ERC: "4,1", or "0".
std::string history_text(const Setup& setup, const Errors& errors);

/// Write and read the history in a memory image: the errors of each module, the last one first, as ERC(0),
/// ERC(1) ..., T1ERC(0) ... Reading removes them from the image. It throws NvError for numbers that are not
/// errors.
void write_history(const std::array<Errors, kModules>& errors, NvImage& image);
std::array<Errors, kModules> read_history(const Setup& setup, NvImage& image);

}  // namespace understudy::emulator::models::slim
