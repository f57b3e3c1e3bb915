#include "emulator/models/models.h"

#include <array>

#include "emulator/device/model.h"
#include "emulator/models/simple2_r3/model.h"
#include "emulator/models/slim/model.h"
#include "emulator/models/super_40nc/model.h"

namespace understudy::emulator::models {

ModelList all_models() {
  static const std::array<const Model*, 3> models{&simple2_r3::model(), &slim::model(), &super_40nc::model()};
  return models;
}

}  // namespace understudy::emulator::models
