#include "emulator/models/slim/language.h"

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "emulator/models/slim/device.h"

namespace understudy::emulator::models::slim {

namespace {

class ProgramText final : public ProgramLanguage {
 public:
  std::string_view name() const override { return "SLIM program"; }
  std::string_view file_ending() const override { return ".slim"; }
  /// Creates a device, because many details of a line depend on its choices.
  std::vector<ProgramMistake> check(std::string_view text, const DeviceSettings& settings) const override {
    return Slim(settings).mistakes_in(text);
  }
  std::vector<ProgramPart> parts(std::string_view text, const DeviceSettings& settings) const override {
    return Slim(settings).parts_of(text);
  }
  std::span<const ProgramControl> controls() const override {
    using By = ProgramControl::By;
    static constexpr std::array<ProgramControl, 2> kControls{
        {{"start", By::text, "G"}, {"leave", By::text, "EXIT"}}};
    return kControls;
  }
};

}  // namespace

const ProgramLanguage& language() {
  static const ProgramText text;
  return text;
}

}  // namespace understudy::emulator::models::slim
