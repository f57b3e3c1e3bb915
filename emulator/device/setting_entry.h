// Reports a wrong entry of a setting that has several entries.
#pragma once

#include <string>

#include "emulator/device/model.h"

namespace understudy::emulator {

/// An error in `set`, `choices` or `dip`.
struct SettingEntryError : SettingError {
  /// `message` is for messages that do not name the entry.
  SettingEntryError(std::string setting_name, std::string entry_name, std::string what_is_wrong,
                    const std::string& message)
      : SettingError(std::move(setting_name), message),
        entry(std::move(entry_name)),
        diagnostic(std::move(what_is_wrong)) {}
  SettingEntryError(std::string setting_name, std::string entry_name, const std::string& what_is_wrong)
      : SettingEntryError(std::move(setting_name), std::move(entry_name), what_is_wrong, what_is_wrong) {}
  std::string entry;
  std::string diagnostic;
};

}  // namespace understudy::emulator
