// SUPER-40NC: the meanings of the panel's contacts (M85x 人機對應接點的功用).
#pragma once

#include "emulator/device/register_map/row.h"

namespace understudy::emulator::models::super_40nc {

// clang-format off
inline constexpr Meaning kPagesLeft[] = {  // M8500 to M8501
    {"the panel leaves the parameter page", "參數頁回主畫面時需觸發"},
    {"the panel leaves the edit page", "編輯頁回主畫面時需觸發"},
};
inline constexpr Meaning kEditKeys[] = {  // M8503 to M8506
    {"key: next page of the editor", "下頁鍵(編輯用)"},
    {"key: previous page of the editor", "上頁鍵(編輯用)"},
    {"key: insert a line", "插入鍵(編輯頁用)"},
    {"key: delete a line", "刪除鍵(編輯頁用)"},
};
inline constexpr Meaning kRunKeys[] = {  // M8508 to M8510
    {"key: start", "啟動鍵"},
    {"key: stop", "停止鍵"},
    {"key: pause", "暫停鍵"},
};
inline constexpr Meaning kHandKeys[] = {  // M8511 to M8512
    {"key: manual page", "手動鍵"},
    {"no function in the manual, plain storage", ""},
};
inline constexpr Meaning kZeroKeys[] = {  // M8513 to M8514
    {"key: return to zero", "回零點鍵"},
    {"key: set the origin", "原點設定鍵"},
};
inline constexpr Meaning kFileKeys[] = {  // M8515 to M8518
    {"key: line above in the editor", "上一行(編輯用)"},
    {"key: line below in the editor", "下一行(編輯用)"},
    {"key: delete the file", "刪除檔案確定鍵"},
    {"key: do not delete the file", "刪除檔案離開鍵"},
};
inline constexpr Meaning kManualKeys[] = {  // M8560 to M8597
    {"manual page, key: jog X in the positive direction", "手動頁 +X 鍵"},
    {"manual page, key: jog X in the negative direction", "手動頁 -X 鍵"},
    {"manual page, key: jog Y in the positive direction", "手動頁 +Y 鍵"},
    {"manual page, key: jog Y in the negative direction", "手動頁 -Y 鍵"},
    {"manual page, key: jog Z in the positive direction", "手動頁 +Z 鍵"},
    {"manual page, key: jog Z in the negative direction", "手動頁 -Z 鍵"},
    {"manual page, key: jog U in the positive direction", "手動頁 +U 鍵"},
    {"manual page, key: jog U in the negative direction", "手動頁 -U 鍵"},
    {"manual page, key: homing of X", "手動頁 X 軸 HOME 鍵"},
    {"manual page, key: homing of Y", "手動頁 Y 軸 HOME 鍵"},
    {"manual page, key: homing of Z", "手動頁 Z 軸 HOME 鍵"},
    {"manual page, key: homing of U", "手動頁 U 軸 HOME 鍵"},
    {"manual page, key: return X to zero", "手動頁 X 軸 ZERO 鍵"},
    {"manual page, key: return Y to zero", "手動頁 Y 軸 ZERO 鍵"},
    {"manual page, key: return Z to zero", "手動頁 Z 軸 ZERO 鍵"},
    {"manual page, key: return U to zero", "手動頁 U 軸 ZERO 鍵"},
    {"manual page, key: set the zero of X", "手動頁 X 軸 OSET 鍵"},
    {"manual page, key: set the zero of Y", "手動頁 Y 軸 OSET 鍵"},
    {"manual page, key: set the zero of Z", "手動頁 Z 軸 OSET 鍵"},
    {"manual page, key: set the zero of U", "手動頁 U 軸 OSET 鍵"},
    {"manual page, key: start the program of X", "手動頁 X 軸 START 鍵"},
    {"manual page, key: start the program of Y", "手動頁 Y 軸 START 鍵"},
    {"manual page, key: start the program of Z", "手動頁 Z 軸 START 鍵"},
    {"manual page, key: start the program of U", "手動頁 U 軸 START 鍵"},
    {"manual page, key: stop X", "手動頁 X 軸 STOP 鍵"},
    {"manual page, key: stop Y", "手動頁 Y 軸 STOP 鍵"},
    {"manual page, key: stop Z", "手動頁 Z 軸 STOP 鍵"},
    {"manual page, key: stop U", "手動頁 U 軸 STOP 鍵"},
    {"manual page, key: pause X", "手動頁 X 軸 PAUSE 鍵"},
    {"manual page, key: pause Y", "手動頁 Y 軸 PAUSE 鍵"},
    {"manual page, key: pause Z", "手動頁 Z 軸 PAUSE 鍵"},
    {"manual page, key: pause U", "手動頁 U 軸 PAUSE 鍵"},
    {"main page, key: homing of all axes", "首頁 原點鍵"},
    {"main page, key: return of all axes to zero", "首頁 零點鍵"},
    {"main page, key: set the zero of all axes", "首頁 設零鍵"},
    {"main page, key: start", "首頁 起動鍵"},
    {"main page, key: stop", "首頁 停止鍵"},
    {"main page, key: pause", "首頁 暫停鍵"},
};
// clang-format on

}  // namespace understudy::emulator::models::super_40nc
