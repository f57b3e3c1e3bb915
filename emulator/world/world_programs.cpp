// Loads programs into devices, and executes commands by name.
#include <cstddef>
#include <string_view>

#include "emulator/device/command_window.h"
#include "emulator/device/device.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/text/text_protocol.h"
#include "emulator/world/outside.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

void World::load_program(std::size_t device, std::string_view text) {
  run_due_lines();
  // Refused programs are also reported, whatever the reason, because the device may show the refusal.
  const auto report = [&](bool is_refused) {
    if (devices_[device]->user_program() != nullptr) {
      notify([&](OutsideListener& listener) { listener.on_program(device, text, is_refused); });
    }
    poll_text(now_);
  };
  try {
    emulator::load_program(*devices_[device], text);
  } catch (const ProgramError&) {
    report(true);
    throw;
  }
  report(false);
}

Objection World::command(std::size_t device, std::string_view text) {
  run_due_lines();
  if (TextProtocol* const protocol = devices_[device]->text_protocol()) {
    notify([&](OutsideListener& listener) { listener.on_command(device, text); });
    const DeviceAnswer answer = protocol->take_command(text);
    poll_text(now_);
    return {.refusal = answer.refusal, .cause = Cause::none, .reason = answer.reason};
  }
  const auto [first, words] = window_message(*devices_[device], text);
  notify([&](OutsideListener& listener) { listener.on_command(device, text); });
  return write_request(*devices_[device]->register_bank(), Table::holding, first, words);
}

}  // namespace understudy::emulator::world
