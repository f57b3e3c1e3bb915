#include "emulator/models/models.h"

#include <array>

#include "emulator/device/model.h"
#include "emulator/models/rs_m8194h/model.h"
#include "emulator/models/simple2_r3/model.h"
#include "emulator/models/slim/model.h"
#include "emulator/models/super_40nc/model.h"

namespace understudy::emulator::models {

ModelList all_models() {
  static constexpr std::array<ListedModel, 4> kModels{{{rs_m8194h::kName, rs_m8194h::model},
                                                       {simple2_r3::kName, simple2_r3::model},
                                                       {slim::kName, slim::model},
                                                       {super_40nc::kName, super_40nc::model}}};
  return kModels;
}

}  // namespace understudy::emulator::models
