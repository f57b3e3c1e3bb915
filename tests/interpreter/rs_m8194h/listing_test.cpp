// Macros and triggers as text.
#include "interpreter/rs_m8194h/listing.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace understudy::interpreter::rs_m8194h {
namespace listing_test {

std::vector<std::string> errors_of(const std::string& text) {
  std::vector<std::string> errors;
  for (const TextError& error : parse_listing(text).errors) errors.push_back(to_string(error));
  return errors;
}

constexpr const char* kCanonical = R"(MP 21
  RSM_MACRO_SET_VAR VAR1 10
  RSM_MACRO_FOR VAR1
    RSM_MACRO_IF VAR1 <= 5
      RSM_MACRO_FIXED_MOVE XYZU 1000
    RSM_MACRO_ELSE
      RSM_MACRO_EXIT_FOR
    RSM_MACRO_END_IF
  RSM_MACRO_NEXT
END

ISR 3
  RSM_MACRO_GET_LP X
  RSM_MACRO_SET_RVAR VAR5
END

MP 4
END

TRIGGER 8.0 off_to_on MP21
TRIGGER 8.1 on hold U
TRIGGER 9.15 off abort_command
TRIGGER 9.14 none
TRIGGER 10.0 on_to_off abort_macro
TRIGGER 15.14 change pause
TRIGGER 15.15 on clear_stop
)";

TEST(RsM8194hListing, IsReadAndWrittenWithoutLoss) {
  const ParsedListing parsed = parse_listing(kCanonical);
  EXPECT_EQ(errors_of(kCanonical), std::vector<std::string>{});
  ASSERT_EQ(parsed.listing.macros.size(), 3U);
  ASSERT_EQ(parsed.listing.triggers.size(), 7U);
  EXPECT_EQ(parsed.listing.macros[1].name, (MacroName{true, 3}));
  EXPECT_EQ(parsed.listing.triggers[0],
            (ListedTrigger{0, {TriggerCondition::off_to_on, TriggerEvent::call_mp, 21}}));
  EXPECT_EQ(parsed.listing.triggers[1], (ListedTrigger{1, {TriggerCondition::on, TriggerEvent::hold, 8}}));
  EXPECT_EQ(parsed.listing.triggers[6].channel, 127);
  EXPECT_EQ(text_of(parsed.listing), kCanonical);
  EXPECT_EQ(parse_listing(text_of(parsed.listing)).listing, parsed.listing);
}

TEST(RsM8194hListing, LinesOfProgramFlowLeadWhereTheyShould) {
  const Macro macro = parse_listing(kCanonical).listing.macros[0].macro;
  EXPECT_EQ(macro.leads_to, (std::vector<std::uint16_t>{1, 8, 5, 4, 7, 8, 7, 2}));
}

TEST(RsM8194hListing, MayBeWrittenLoosely) {
  const ParsedListing parsed = parse_listing(
      "\xEF\xBB\xBF; a program\r\n\r\nmp 1 ; first\r\nrsm_macro_goto 3\nRSM_MACRO_LABEL 3\nISR 0x02\ntrigger "
      "8.0 "
      "CHANGE mp157");
  ASSERT_EQ(parsed.errors, std::vector<TextError>{});
  EXPECT_EQ(text_of(parsed.listing),
            "MP 1\n  RSM_MACRO_GOTO 3\n  RSM_MACRO_LABEL 3\nEND\n\nISR 2\nEND\n\nTRIGGER 8.0 change MP157\n");
  EXPECT_EQ(text_of(parse_listing("").listing), "");
}

TEST(RsM8194hListing, ErrorsHaveTheirPlaces) {
  const std::pair<std::string, std::string> kCases[] = {
      {"MP 158\nEND", "1:4: expected the number of an MP, 1 to 157"},
      {"ISR\nEND", "1:1: expected the number of an ISR, 1 to 20"},
      {"MP 1\nEND\nMP 1\nEND", "3:4: MP1 appears twice"},
      {"RSM_MACRO_NEXT", "1:1: 'RSM_MACRO_NEXT' is not in a macro; expected MP, ISR or TRIGGER"},
      {"END", "1:1: END without a macro; expected MP or ISR before it"},
      {"MP 1\nEND 2", "2:5: '2' follows END; expected nothing"},
      {"MP 1\n  RSM_FIXED_MOVE X 1\nEND",
       "2:3: RSM_FIXED_MOVE: a real-time command in a macro; expected RSM_MACRO_FIXED_MOVE"},
      {"ISR 1\nRSM_MACRO_TIMER 5\nEND", "2:1: RSM_MACRO_TIMER: not allowed in an ISR"},
      {"MP 1\nRSM_MACRO_MP_CLOSE\nEND", "2:1: RSM_MACRO_MP_CLOSE is not a line of a macro; expected END"},
      {"MP 1\nRSM_MACRO_NEXT\nRSM_MACRO_ELSE\nEND", "2:1: RSM_MACRO_NEXT: NEXT without a FOR"},
      {"MP 1\n\nRSM_MACRO_FOR 2\nEND", "3:1: RSM_MACRO_FOR: FOR without a NEXT"},
      {"MP 1\nRSM_MACRO_GOTO 2\nEND", "2:1: RSM_MACRO_GOTO: GOTO without its label"},
      {"MP 1\nRSM_MACRO_IF 1 < x\nRSM_MACRO_END_IF\nEND",
       "2:18: parameter varNo1: 'x' does not fit; expected -2000000000 to 2000000000, or VAR0 to VAR511"},
      {"TRIGGER 7.0 on pause", "1:9: '7.0' does not fit; expected an input, 8.0 to 15.15"},
      {"TRIGGER 8.16 on pause", "1:9: '8.16' does not fit; expected an input, 8.0 to 15.15"},
      {"TRIGGER", "1:1: ends too early; expected an input, 8.0 to 15.15"},
      {"TRIGGER 8.0 up pause",
       "1:13: 'up' does not fit; expected none, on, off, off_to_on, on_to_off or change"},
      {"TRIGGER 8.0 on MP158",
       "1:16: 'MP158' does not fit; expected MP1 to MP157, hold, abort_command, abort_macro, pause or "
       "clear_stop"},
      {"TRIGGER 8.0 on hold XY", "1:21: 'XY' does not fit; expected an axis, X, Y, Z or U"},
      {"TRIGGER 8.0 none pause", "1:18: 'pause' does not fit; expected nothing"},
      {"MP 1\n  SET_V X 1\nEND", "2:3: 'SET_V' is not a command; the nearest is 'RSM_MACRO_SET_V'"},
      {"TRIGGER 8.0 on pause X", "1:22: 'X' does not fit; expected nothing"},
      {"TRIGGER 8.0 on pause\nTRIGGER 8.0 off pause", "2:9: TRIGGER 8.0 appears twice"},
  };
  for (const auto& [text, error] : kCases) EXPECT_EQ(errors_of(text), std::vector{error}) << text;
}

TEST(RsM8194hListing, AllErrorsAreReported) {
  EXPECT_EQ(errors_of("MP 1\nRSM_X\nRSM_MACRO_TIMER\nMP 0\nTRIGGER 1.1 on pause").size(), 4U);
  std::string text = "MP 1\n";
  for (int i = 0; i < 9; ++i) text += "RSM_MACRO_SET_VAR VAR1 1\n";
  EXPECT_EQ(errors_of(text),
            std::vector<std::string>{"10:1: RSM_MACRO_SET_VAR: more lines than this macro has room for"});
}

TEST(RsM8194hListing, TheFirstErrorOfAMacroIsReportedWhicheverCounts) {
  struct Case {
    std::string lines;
    std::string error;
  };
  const Case kCases[] = {
      {"FOR 1\nRSM_MACRO_ELSE", "3:1: RSM_MACRO_ELSE: ELSE outside an IF"},  // and nothing closes the FOR
      {"NEXT\nRSM_MACRO_ELSE", "2:1: RSM_MACRO_NEXT: NEXT without a FOR"},
      {"GOTO 1\nRSM_MACRO_NEXT", "3:1: RSM_MACRO_NEXT: NEXT without a FOR"},
  };
  for (const Options& options : {Options{}, Options{option("kept_error", "the_last")}}) {
    for (const Case& each : kCases) {
      const std::string text = "MP 1\nRSM_MACRO_" + each.lines + "\nEND";
      const ParsedListing parsed = parse_listing(text, options);
      ASSERT_EQ(parsed.errors.size(), 1U) << text;
      EXPECT_EQ(to_string(parsed.errors[0]), each.error) << text;
    }
  }
}

TEST(RsM8194hListing, AMacroThatAppearsTwiceIsNotReadFurther) {
  EXPECT_EQ(errors_of("MP 1\nEND\nMP 1\nRSM_MACRO_NEXT\nEND\nMP 2\nRSM_MACRO_ELSE\nEND"),
            (std::vector<std::string>{"3:4: MP1 appears twice", "7:1: RSM_MACRO_ELSE: ELSE outside an IF"}));
}

}  // namespace listing_test
}  // namespace understudy::interpreter::rs_m8194h
