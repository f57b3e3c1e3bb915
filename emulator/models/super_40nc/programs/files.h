// The SUPER-40NC's flash: programs, path files (selected by D9001) and recipes (selected by D9002), all of
// which are texts (《D9 參數暫存器的功用(一般用)》).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "emulator/device/memory/text_blocks.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr std::string_view kPrograms = "programs";  // one per area
inline constexpr std::string_view kFiles = "files";        // programs for C, by number
inline constexpr std::string_view kRecipes = "recipes";
inline constexpr int kRecipeCount = 100;
// The range according to D9002's own text. Other pages of the manual mention D800 or D900 to D999.
inline constexpr int kFirstOfRecipe = 500;
inline constexpr int kLastOfRecipe = 999;
inline constexpr std::size_t kRecipeRegisters = kLastOfRecipe - kFirstOfRecipe + 1;

std::span<const BlockKind> block_kinds();

/// Returns the name of a recipe, "00" to "99".
std::string recipe_name(std::int32_t number);
/// Writes a recipe as text: the registers from D500 on that are not 0, one per line, such as "D500 12".
std::string recipe_text(std::span<const std::uint32_t> values, int first);
/// Reads a text that block_kinds() accepts into `values`.
void read_recipe(std::string_view text, std::span<std::uint32_t> values, int first);

}  // namespace understudy::emulator::models::super_40nc
