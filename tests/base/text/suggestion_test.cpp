#include "base/text/suggestion.h"

#include <gtest/gtest.h>

#include <vector>

namespace understudy {
namespace suggestion_test {

using Strings = std::vector<std::string>;

TEST(NearWord, HasTheFewestChangesWithinAThirdOfItsLetters) {
  struct Case {
    std::string word;
    Strings known;
    std::optional<std::string> near;
  };
  const std::vector<Case> cases = {
      {"Aaxis_Sped", {"Aaxis_Pulse", "Aaxis_Speed", "Baxis_Speed"}, "Aaxis_Speed"},
      {"kitten", {"smitten", "sitting", "mitten"}, "mitten"},
      {"exact", {"exacts", "exact", "exac"}, "exact"},
      {"tie", {"tia", "tib"}, "tia"},             // the first of equals
      {"nht", {"at", "for", "nth"}, "nth"},       // two neighbours swapped are one change
      {"SERVO", {"stop", "servo"}, "servo"},      // capitals equal small letters
      {"jam", {"alarm", "stall"}, std::nullopt},  // 2 changes: al+arm; 3 letters allow 1
      {"abcdef", {"abcdXY"}, "abcdXY"},           // 6 letters allow 2
      {"abcdef", {"abcXYZ"}, std::nullopt},       // and not 3
      {"abcdefghi", {"abcdefXYZ"}, "abcdefXYZ"},  // 9 allow 3
      {"y", {"x"}, std::nullopt},                 // nothing would be left
      {"ya", {"xa"}, "xa"},
      {"puls", {"speed", "pulses"}, "pulses"},            // 2 changes, but a prefix of it
      {"Cord", {"Curve", "Cord_A", "Cord_B"}, "Cord_A"},  // 2 changes; the first one with this beginning
      {"cor", {"Chord", "Cord_A"}, "Cord_A"},
      {"co", {"Cord_A"}, std::nullopt},  // too short to tell
      {"", {"longest", "ab"}, std::nullopt},
      {"anything", {}, std::nullopt},
      {std::string(65, 'x'), {std::string(64, 'x')}, std::nullopt},  // no name is this long
  };
  for (const Case& c : cases) EXPECT_EQ(near_word(c.word, c.known), c.near) << c.word;
}

TEST(Suggestion, NamesTheNearestOrElseWhatThereIs) {
  struct Case {
    std::string word;
    Strings known;
    std::string text;
  };
  const std::vector<Case> cases = {
      {"feedr", {"feeder", "turner"}, "; the nearest is 'feeder'"},
      {"mill", {"feeder"}, "; expected 'feeder'"},
      {"mill", {"feeder", "turner"}, "; expected one of feeder, turner"},
      {"mill", {"a", "b", "c", "d", "e", "f", "g", "h"}, "; expected one of a, b, c, d, e, f, g, h"},
      {"mill", {"a", "b", "c", "d", "e", "f", "g", "h", "i"}, "; expected one such as 'a'"},
      {"mill", {}, "; there is none"},
  };
  for (const Case& c : cases) EXPECT_EQ(suggestion(c.word, c.known), c.text) << c.word;
  EXPECT_EQ(suggestion("DIP3", {}, "it has none"), "; it has none");
}

}  // namespace suggestion_test
}  // namespace understudy
