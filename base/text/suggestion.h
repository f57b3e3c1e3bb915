// What to say about a word that is not known.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace understudy {

/// The known word that differs least, if it is near enough to be what was meant: about a third of the letters
/// may be missing, too many, others, or swapped with their neighbours. Capitals count as small letters.
std::optional<std::string> near_word(std::string_view word, std::span<const std::string> known);

/// The end of a complaint: "; the nearest is 'speed'". Where none is near, "; expected one of A, B", or of
/// many an example; where nothing is known, "; " and `none`.
std::string suggestion(std::string_view word, std::span<const std::string> known,
                       const std::string& none = "there is none");

}  // namespace understudy
