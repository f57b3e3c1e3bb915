// Letters made of strokes, for pictures that are drawn without fonts.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace understudy::emulator::page {

inline constexpr double kAdvance = 0.55;      // from one letter to the next, in sizes of the text
inline constexpr double kStrokeAcross = 0.1;  // one step of a stroke to the right
inline constexpr double kStrokeDown = 0.12;   // the same step downwards

// The strokes of each character from the space on: pairs of digits, how far to the right (0 to 4) and how far
// down (0 to 8; the baseline is 6). A space lifts the pen.
inline constexpr std::array<std::string_view, 95> kStrokes{
    "", "2024 2626", "1012 3032", "1016 3036 0242 0444", "413010010213334445361605 2026", "0640 1111 3535",
    "4612112031320405162644", "2022", "30121436", "10323416", "2125 0244 0442", "2125 0343", "2617", "0343",
    "2626", "0640",
    // 0 to 9
    "103041453616050110", "112026 1636", "01103041420646", "0110304142334445361605 2333", "300444 3036",
    "400002324345361605", "413010010516364544331304", "004016", "13020110304142331304051636454433",
    "051636454130100102133342", "2222 2626", "2222 2617", "410345", "0242 0444", "014305",
    "01103041422324 2626", "4536160501103041433423",
    // A to Z
    "062046 1434", "0333424130000636454433", "4130100105163645", "00063645413000", "40000646 0333",
    "400006 0333", "41301001051636454323", "0006 4046 0343", "1030 2026 1636", "4045361605", "0006 400346",
    "000646", "0600234046", "06004640", "103041453616050110", "06003041423303", "103041453616050110 2546",
    "06003041423303 2346", "413010010213334445361605", "0040 2026", "000516364540", "002640", "0016233640",
    "0046 4006", "002340 2326", "00400646", "30101636", "0046", "10303616", "122032", "0747", "1021",
    // a to z
    "12324346 441405163645", "0006 0312324345361605", "4332120305163645", "4046 4332120305163645",
    "044443321203051636", "40302126 1232", "4332120305163645 4247381807", "0006 0312324346", "2226 2020",
    "22271807 2020", "0006 320436", "10202636", "0602 03122326 23324346", "0602 0312324346",
    "123243453616050312", "0208 0312324345361605", "4248 4332120305163645", "0602 03123243",
    "43321203143445361605", "20253646 1232", "0205163645 4246", "022642", "0216243642", "0246 4206",
    "0225 4208", "02420646", "30212213242536", "2027", "10212233242516", "03123342"};

inline constexpr std::string_view kArrowStrokes = "0343 324334";
inline constexpr std::string_view kDotsStrokes = "0606 2626 4646";
inline constexpr std::string_view kOtherStrokes = "1016363010";

/// Returns the strokes of the first character of a text, and removes it from the text.
inline std::string_view next_strokes(std::string_view& text) {
  const auto code = static_cast<unsigned char>(text.front());
  std::size_t bytes = 1;
  while (bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U) ++bytes;
  const std::string_view character = text.substr(0, bytes);
  text.remove_prefix(bytes);
  if (code >= ' ' && code - ' ' < static_cast<int>(kStrokes.size())) return kStrokes[code - ' '];
  if (character == "\xE2\x86\x92") return kArrowStrokes;
  return character == "\xE2\x80\xA6" ? kDotsStrokes : kOtherStrokes;
}

}  // namespace understudy::emulator::page
