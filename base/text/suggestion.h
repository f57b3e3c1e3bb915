// Creates the suggestion in a message about an unknown word.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace understudy {

/// Returns the known word that differs least, if it is close enough: about a third of its letters may be
/// missing, extra, different, or swapped with their neighbours. Case does not matter.
std::optional<std::string> near_word(std::string_view word, std::span<const std::string> known);

/// Returns the end of a message: "; the nearest is 'speed'". If no word is close, it is "; expected one of A,
/// B", or an example if there are many words. If there are no known words, it is "; " followed by `none`.
std::string suggestion(std::string_view word, std::span<const std::string> known,
                       const std::string& none = "there is none");

}  // namespace understudy
