// The traps of the language: similar forms, quotes, blanks, labels, prefixes.
#include "interpreter/slim/parse.h"

#include <gtest/gtest.h>

#include "interpreter/slim/availability.h"
#include "interpreter/slim/text_of.h"
#include "interpreter/slim/unknown_line.h"

namespace understudy::interpreter::slim {
namespace parse_test {

Command command_of(std::string_view text) {
  const ParseResult result = parse_line(text);
  EXPECT_EQ(result.error, Error::none) << text;
  EXPECT_TRUE(result.line.command) << text;
  return result.line.command.value_or(Command{});
}

struct SameCase {
  std::string_view written;
  std::string_view meant;
};

TEST(SlimParse, BlanksAndCapitalsDoNotMatter) {
  for (const SameCase& each : {SameCase{"  ma   10000\t", "MA 10000"},
                               {"ma -5", "MA-5"},
                               {"MA +5", "MA 5.0"},
                               {"MA .5", "MA 0.5"},
                               {"MA 5.", "MA 5"},
                               {"MA 1e2", "MA 100"},
                               {"2mA 100 ,  50", "2MA 100,50"},
                               {"pr2 =\t1000", "PR2=1000"},
                               {"ns( n3 ) = 5", "NS(N3)=5"},
                               {"t1ma 5", "T1MA 5"},
                               {"jg 0 , n0 , $loop", "JG 0,N0,$LOOP"},
                               {"on ev1 , $ppz", "ON EV1,$PPZ"},
                               {"set ev1  nz , n0", "SET EV1 NZ,N0"},
                               {"save\td", "SAVE D"},
                               {"?Time", "?time"},
                               {"OUT\"x\"", "OUT \"x\""},
                               {"OUT \xE2\x80\x9Cx\xE2\x80\x9D", "OUT \"x\""},
                               {"OUT \xE2\x80\x9Dx\xE2\x80\x9D", "OUT \"x\""},
                               {"OUT \xEF\xBC\x82x\xEF\xBC\x82", "OUT \"x\""}}) {
    const ParseResult written = parse_line(each.written);
    EXPECT_EQ(written.error, Error::none) << each.written;
    EXPECT_EQ(written, parse_line(each.meant)) << each.written;
  }
}

struct VerbCase {
  std::string_view text;
  Verb verb;
  int module = -1;
};

TEST(SlimParse, TheLongestWholeWordDecides) {
  for (const VerbCase& each : {VerbCase{"JG 0,N0,$A", Verb::jump_if},
                               {"JG0", Verb::jog_stop},
                               {"H", Verb::home},
                               {"HON", Verb::servo_on},
                               {"G", Verb::run},
                               {"GETI", Verb::get_integer},
                               {"PL", Verb::program_list},
                               {"PLS P1,2", Verb::pulse_port},
                               {"PE 1", Verb::program_edit},
                               {"?PE", Verb::query_coordinate},
                               {"P1SET P1,0", Verb::set_port_at},
                               {"PZ", Verb::pause},
                               {"DN", Verb::wait_done},
                               {"DF", Verb::default_parameters},
                               {"DLP", Verb::download},
                               {"DATA N0,1", Verb::set_variable},
                               {"R0=1", Verb::set_variable},
                               {"RS(1)=1", Verb::set_variable},
                               {"RET", Verb::return_},
                               {"REDO", Verb::redo},
                               {"RESET", Verb::reset},
                               {"RESET H", Verb::reboot},
                               {"NS(0)=1", Verb::set_variable},
                               {"SET P1", Verb::set_port},
                               {"SET EV1 I,1", Verb::set_event},
                               {"CLR P1", Verb::clear_port},
                               {"CLR BUF", Verb::clear_buffer},
                               {"SAVE C", Verb::save_parameters},
                               {"SAVE P", Verb::save_program},
                               {"?TM", Verb::query_parameter},
                               {"?TEMP", Verb::query_temperature},
                               {"?time", Verb::query_time},
                               {"?T1TEMP", Verb::query_temperature, 1},
                               {"?T1PR3", Verb::query_parameter, 1},
                               {"?IN", Verb::query_input},
                               {"?IC", Verb::query_mean_current},
                               {"?IMX", Verb::query_peak_current},
                               {"OUT N0", Verb::print},
                               {"OUTP 3", Verb::set_all_ports},
                               {"TX=1", Verb::map_axis},
                               {"TVM=1", Verb::set_path_speed},
                               {"T1TVM=1", Verb::set_parameter, 1},
                               {"TVA=1", Verb::set_parameter},
                               {"TM=0", Verb::set_parameter},
                               {"TAPZ", Verb::pause_all},
                               {"T0MA 5", Verb::move_absolute, 0},
                               {"MA 5", Verb::move_absolute},
                               {"T1H", Verb::home, 1},
                               {"T2PR3=200", Verb::set_parameter, 2},
                               {"T0SYN=2", Verb::set_parameter, 0}}) {
    const Command command = command_of(each.text);
    EXPECT_EQ(command.verb, each.verb) << each.text;
    EXPECT_EQ(command.module, each.module) << each.text;
  }
}

TEST(SlimParse, NamesOfParametersAndQueries) {
  EXPECT_EQ(command_of("t2pr3=200").name, "PR3");
  EXPECT_EQ(command_of("FU=1").name, "FU");
  EXPECT_EQ(command_of("T0SYN=2").name, "SYN");
  EXPECT_EQ(command_of("?t1err").name, "ERR");
  EXPECT_EQ(command_of("?LL").name, "LL");
  EXPECT_EQ(command_of("?PN50").name, "PN50");
}

TEST(SlimParse, TheReceivingVariableComesFirst) {
  using Kind = Operand::Kind;
  for (const std::string_view text : {"AIN=N7", "N7=AIN"}) {
    const Command command = command_of(text);
    EXPECT_EQ(command.verb, Verb::set_variable);
    EXPECT_EQ(command.operands[0], (Operand{.kind = Kind::integer_variable, .index = 7}));
    EXPECT_EQ(command.operands[1], (Operand{.kind = Kind::analog}));
  }
  EXPECT_EQ(command_of("N0=TM").operands[1].kind, Kind::clock);
  EXPECT_EQ(command_of("R0=TM").operands[1].kind, Kind::clock);
  EXPECT_EQ(command_of("N0=GETI").operands[1].kind, Kind::get_integer);
  EXPECT_EQ(command_of("R0=GETR").operands[1].kind, Kind::get_real);
  const Command clock = command_of("TM=N0");
  EXPECT_EQ(clock.name, "TM");
  EXPECT_EQ(clock.operands[0].kind, Kind::integer_variable);
  const Command data = command_of("DATA R3,0.5");
  EXPECT_EQ(data.operands[0], (Operand{.kind = Kind::real_variable, .index = 3}));
  EXPECT_EQ(data.operands[1].number, 0.5);
}

TEST(SlimParse, Labels) {
  EXPECT_EQ(parse_line("$ppz").line, (ParsedLine{.label = "PPZ"}));
  EXPECT_EQ(parse_line("$A_1  SET P1").line.label, "A_1");
  EXPECT_EQ(parse_line("$A_1  SET P1").line.command, command_of("SET P1"));
  EXPECT_EQ(command_of("JP $a").operands[0].text, "A");
  EXPECT_EQ(command_of("JP 12").operands[0].number, 12);
  for (const std::string_view wrong :
       {"$", "$ A", "$A=5", "$A: SET P1", "$A SET P1 $B", "SET P1 $A", "$A $B"}) {
    EXPECT_EQ(parse_line(wrong).error, Error::syntax) << wrong;
  }
}

TEST(SlimParse, TextsKeepTheirCapitalsAndSigns) {
  EXPECT_EQ(command_of("out \" a,B = $x ?\"").operands[0].text, " a,B = $x ?");
  EXPECT_EQ(command_of("OUT \"\"").operands[0].text, "");
  EXPECT_EQ(command_of("OUT \xE2\x80\x9Csay \"so\"\xE2\x80\x9D").operands[0].text, "say \"so\"");
  EXPECT_EQ(parse_line("OUT \"a\"b\"").error, Error::syntax);
  EXPECT_EQ(parse_line("OUT \xE2\x80\x9Cx\"").error, Error::syntax);
  EXPECT_EQ(parse_line("MA \"5\"").error, Error::syntax);
}

TEST(SlimParse, EmptyLongAndForeignLines) {
  EXPECT_EQ(parse_line("").error, Error::none);
  EXPECT_EQ(parse_line(" \t ").line, ParsedLine{});
  const std::string text = "OUT \"" + std::string(121, 'x') + "\"";
  ASSERT_EQ(text.size(), 127u);
  EXPECT_EQ(parse_line(text).error, Error::none);
  EXPECT_EQ(parse_line(text + " ").error, Error::syntax);
  for (const std::string_view wrong :
       {"=", "?", ",", "\"x\"", "\xFF\xFE", "MA inf", "MA nan", "MA 1e", "MA -", "MA 1.2.3", "MA --5",
        "MA +-5", "N0==5", "?=", "T1", "T", "HELLO"}) {
    EXPECT_EQ(parse_line(wrong).error, Error::syntax) << wrong;
  }
  EXPECT_EQ(parse_line(std::string_view("MA\0 5", 5)).error, Error::syntax);
}

struct PlaceCase {
  std::string_view text;
  bool program;
  bool immediate;
  bool external;
};

/// The manual's columns if it has them; otherwise what makes sense to store or to type.
TEST(SlimAvailability, ByPlace) {
  for (const PlaceCase& each : {PlaceCase{"TAPZ", true, true, true},
                                {"TASTOP", true, true, true},
                                {"TVM=5", true, true, true},
                                {"2MA 1,2", true, true, false},
                                {"2MA R1,R2", true, true, false},
                                {"2MR R1,R2", true, false, false},
                                {"SAA R1,R2,R3,R4", true, false, false},
                                {"XMA R1", true, false, false},
                                {"XDN", true, false, false},
                                {"TAREDO", true, true, true},  // 外部 is blank; lenient
                                {"TAUPZ", true, true, true},
                                {"JP 0", true, false, false},
                                {"T1DN", true, false, false},
                                {"WT 5", true, false, false},
                                {"G", false, true, false},
                                {"PL", false, true, false},
                                {"EXIT", false, true, true},
                                {"SAVE P", false, true, false},
                                {"?PE", false, true, true},
                                {"?T1PR3", false, true, true},
                                {"MA 5", true, true, false},
                                {"ISET P1", true, true, true},
                                {"PZ", true, true, true},
                                {"SET EV1 I,1", true, true, false},
                                {"PR3=5", true, true, false},
                                {"GETI", true, false, false},
                                {"N0=GETI", true, false, false},  // nothing waits for the number
                                {"TVM=GETR", true, false, false}}) {
    const Command command = command_of(each.text);
    EXPECT_EQ(is_allowed(command, Place::program), each.program) << each.text;
    EXPECT_EQ(is_allowed(command, Place::immediate), each.immediate) << each.text;
    EXPECT_EQ(is_allowed(command, Place::external), each.external) << each.text;
  }
  const Options strict{option("while_program_runs", "external_column_only")};
  EXPECT_TRUE(is_allowed(command_of("EXIT"), Place::external, strict));  // or nothing could end a program
  for (const std::string_view text : {"TAREDO", "?PE", "ISET P1"}) {
    EXPECT_FALSE(is_allowed(command_of(text), Place::external, strict)) << text;
  }
  EXPECT_TRUE(is_allowed(command_of("TAPZ"), Place::external, strict));
  const Options typed{option("immediate_column", "taken")};
  EXPECT_TRUE(is_allowed(command_of("2MR R1,R2"), Place::immediate, typed));
  EXPECT_FALSE(is_allowed(command_of("XDN"), Place::immediate, typed));
}

TEST(SlimParse, SaysWhatALineThatIsNoneOughtToBe) {
  for (const auto& [line, says] : std::vector<std::pair<std::string, std::string>>{
           {"MA 100,200", "'MA 100,200' is not a form of MA; expected MA x, or MA Rn"},
           {"$A JI 1", "'$A JI 1' is not a form of JI; expected JI i,addr"},
           {"wt 1.5", "'wt 1.5' is not a form of WT; expected WT tm"},
           {"T1MA", "'T1MA' is not a form of TpMA; expected TpMA x"},
           {"GOTO $A", "'GOTO $A' is not a command; expected JP addr"},
           {"WAIT 100", "'WAIT 100' is not a command; expected WT tm, WI i or DN"},
           {"CAL 3", "'CAL 3' is not a command; the nearest is 'CALL'"},
           {"NONSENSE",
            "'NONSENSE' is not a command; expected one of `understudy describe slim commands`"}}) {
    EXPECT_EQ(why_not_command(line), says);
  }
}

}  // namespace parse_test
}  // namespace understudy::interpreter::slim
