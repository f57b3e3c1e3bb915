#include "emulator/models/rs_m8194h/commands.h"

#include "base/complete_table.h"
#include "emulator/models/rs_m8194h/event_commands.h"
#include "emulator/models/rs_m8194h/motion_commands.h"
#include "emulator/models/rs_m8194h/setting_commands.h"
#include "interpreter/rs_m8194h/commands.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

constexpr CompleteTable<Verb, CommandAction> kActions(lang::kDeviceVerbs, kSettingCommands, kMotionCommands,
                                                      kEventCommands);

}  // namespace

CommandAction action_of(Verb verb) { return kActions[verb]; }

}  // namespace understudy::emulator::models::rs_m8194h
