// Messages about users' mistakes: every command prints one line that quotes the input and says what was
// expected.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace mistakes_test {

namespace fs = std::filesystem;

struct Mistake {
  Words words;  // names of files begin with @
  int exit_code;
  std::string says;  // the whole line, in which files also begin with @
};

class Mistakes : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return folder_ / name; }
  std::string with_paths(std::string text) const {
    for (std::size_t i = 0; (i = text.find('@', i)) != std::string::npos;) {
      text.replace(i, 1, folder_.path() + "/");
      i += folder_.path().size();
    }
    return text;
  }
  void expect(const Finished& finished, const Mistake& mistake) const {
    const std::string what = testing::PrintToString(mistake.words);
    EXPECT_EQ(finished.exit_code, mistake.exit_code) << what << finished.errors;
    EXPECT_EQ(finished.output, "") << what;
    EXPECT_EQ(finished.errors, with_paths(mistake.says) + "\n") << what;
  }
  void expect_all(const std::vector<Mistake>& mistakes) const {
    for (const Mistake& mistake : mistakes) {
      Words words;
      for (const std::string& word : mistake.words) words.push_back(with_paths(word));
      expect(understudy(words), mistake);
    }
  }
  /// Returns the words of `ctl`.
  void expect_all_of(const RunningUnderstudy& daemon, const std::vector<Mistake>& mistakes) const {
    for (const Mistake& mistake : mistakes) {
      Words words;
      for (const std::string& word : mistake.words) words.push_back(with_paths(word));
      expect(daemon.ctl(words), mistake);
    }
  }

  PrivateFolder folder_;
};

TEST_F(Mistakes, OfFlagsAndWordsAreReportedInOneLine) {
  expect_all({
      {{}, 2, "understudy: expected a command (--help lists them)"},
      {{"help"}, 2, "understudy: 'help' is not a command (--help lists them)"},
      {{"rnu"}, 2, "understudy: 'rnu' is not a command; the nearest is 'run' (--help lists them)"},
      {{"ctl"}, 2, "understudy: ctl: expected a command (--help lists them)"},
      {{"ctl", "stauts"},
       2,
       "understudy: 'stauts' is not a command; the nearest is 'status' (--help lists them)"},
      {{"run", "--filtre", "x", "s.yaml"},
       2,
       "understudy: '--filtre' is not a flag here; the nearest is '--filter' (--help lists them)"},
      {{"run", "--filtre=x", "s.yaml"},
       2,
       "understudy: '--filtre' is not a flag here; the nearest is '--filter' (--help lists them)"},
      {{"--verson"},
       2,
       "understudy: '--verson' is not a flag here; the nearest is '--version' (--help lists them)"},
      {{"ctl", "--josn", "status"},
       2,
       "understudy: '--josn' is not a flag here; the nearest is '--json' (--help lists them)"},
      {{"ctl", "status", "--contrl", "x"},
       2,
       "understudy: '--contrl' is not a flag here; the nearest is '--control' (--help lists them)"},
      {{"serve", "bench.yaml", "--page", "foo"},
       2,
       "understudy: --page: 'foo' is not a whole number, or is too large; expected a whole number"},
      {{"serve", "--model", "slim", "--page", "99999"},
       2,
       "understudy: serve: --page: '99999' is not a port; expected 0 to 65535"},
      {{"poll", "p", "1", "--station", "one"},
       2,
       "understudy: --station: 'one' is not a whole number, or is too large; expected a whole number"},
      {{"run", "s.yaml", "--seed", "-1"},
       2,
       "understudy: --seed: '-1' is not a seed; expected a whole number from 0 to 9223372036854775807"},
      {{"run", "s.yaml", "--junit"}, 2, "understudy: --junit: has no value; expected one"},
      {{"run", "s.yaml", "--junit", ""}, 2, "understudy: --junit: is empty; expected a value"},
      {{"run", "s.yaml", "--junit", "a", "--junit", "b"},
       2,
       "understudy: --junit: is given twice; expected it only once"},
      {{"run", "s.yaml", "--lint=maybe"}, 2, "understudy: --lint: has a value; expected none"},
      {{"run"},
       2,
       "understudy: run: SCENARIO is missing; expected scenario files, or folders whose scenarios are "
       "all run"},
      {{"schema"}, 2, "understudy: schema: WHAT is missing; expected bench, scenario or model"},
      {{"poll"}, 2, "understudy: poll: PORT is missing; expected a serial port, or a link to one"},
      {{"schema", "bench", "scenario", "model"},
       2,
       "understudy: schema: 'scenario' is one argument too many; expected nothing more"},
      {{"ctl", "list", "all", "these"},
       2,
       "understudy: ctl list: 'all' is one argument too many; expected nothing more"},
      {{"page", "--read-only", "--control", "a", "NAME", "--host", "b"},
       2,
       "understudy: page: 'NAME' is one argument too many; expected nothing more"},
      {{"ctl", "--control", "a", "--bench", "b", "status"},
       2,
       "understudy: ctl status: --control and --bench cannot be combined; expected one of the two"},
  });
  EXPECT_EQ(understudy({"--help"}).exit_code, 0);
  EXPECT_EQ(understudy({"run", "--help"}).exit_code, 0);
  EXPECT_EQ(lines_of(understudy({"--version"}).output).size(), 1U);
}

TEST_F(Mistakes, OfValuesAreQuotedWithWhatIsExpected) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  expect_all_of(
      daemon,
      {
          {{"set", "Aaxis_Speed=fast"},
           2,
           "understudy: ctl set: Aaxis_Speed: 'fast' is not a number; expected 0 to 32768"},
          {{"set", "Aaxis_Speed=3.5"},
           2,
           "understudy: ctl set: Aaxis_Speed: 3.5 is not a whole number; expected 0 to 32768"},
          {{"set", "Aaxis_Speed=40000"},
           2,
           "understudy: ctl set: Aaxis_Speed: 40000 is out of range; expected 0 to 32768"},
          {{"set", "Aaxis_SVON=on"},
           2,
           "understudy: ctl set: Aaxis_SVON: 'on' is not a number; expected 0 to 1"},
          {{"set", "DOUT_ALL.3=on"},
           2,
           "understudy: ctl set: DOUT_ALL.3: 'on' is not a number; expected 0 or 1"},
          {{"set", "Aaxis_Sped=fast"},
           2,
           "understudy: ctl set: device: no register is called 'Aaxis_Sped'; the nearest is 'Aaxis_Speed'"},
          {{"set", "Aaxis_Speed"},
           2,
           "understudy: ctl set: 'Aaxis_Speed' is not understood; expected NAME=VALUE"},
          {{"set", "Aaxis_Speed="},
           2,
           "understudy: ctl set: 'Aaxis_Speed=' is not understood; expected NAME=VALUE"},
          {{"turn", "A=abc"},
           2,
           "understudy: ctl turn: A: 'abc' is not a whole number; expected counts, such as 400"},
          {{"turn", "A=2.5"},
           2,
           "understudy: ctl turn: A: 2.5 is not a whole number; expected counts, such as 400"},
          {{"input", "DIN_1=high"},
           2,
           "understudy: ctl input: DIN_1: 'high' is not a level; expected on or off"},
          {{"clear", "9"},
           2,
           "understudy: ctl clear: number: 9 is not a fault in force; expected no number, because no fault "
           "is in force"},
          {{"send", "01", "03"},
           2,
           "understudy: ctl send: line: '01' is unknown; expected one of line; put the bytes in quotes, as "
           "one word"},
          {{"send", "01", "03", "00"},
           2,
           "understudy: ctl send: '00' is one argument too many; expected the bytes in quotes, such as '01 "
           "03 00 "
           "00 00 01'"},
          {{"send", "0x01"},
           2,
           "understudy: ctl send: bytes: '0x01' is not hexadecimal digits; expected bytes such as \"01 03 00 "
           "00 00 01\""},
          {{"advance", "5"}, 2, "understudy: ctl advance: expected one duration with a unit, such as 250ms"},
          {{"scope", "--trace", "@shot.csv"},
           2,
           "understudy: ctl scope: --trace: nothing was recorded; expected a scope that was armed and has "
           "run: "
           "ctl scope "
           "NAME..."},
          {{"scope", "--trace", "@shot.vcd"},
           2,
           "understudy: --trace: @shot.vcd: has an unknown format; expected FILE.csv"},
      });
  ASSERT_EQ(daemon.ctl({"inject", "stall", "A"}).exit_code, 0);
  ASSERT_EQ(daemon.ctl({"inject", "alarm", "B"}).exit_code, 0);
  expect_all_of(daemon, {{{"clear", "9"},
                          2,
                          "understudy: ctl clear: number: 9 is not a fault in force; expected one of 1, 2"}});
}

TEST_F(Mistakes, OfProgramsAreReportedWithTheirFile) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  folder_.write("wrong.lst", "Out 4 1\nOut 4 maybe\nJmp\nEND\n");
  const Finished finished = daemon.ctl({"program", "device", at("wrong.lst")});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_TRUE(finished.errors.starts_with("understudy: ctl program: " + at("wrong.lst") + ":2:7: "))
      << finished.errors;
  EXPECT_NE(finished.errors.find(" more)\n"), std::string::npos) << finished.errors;
}

// A command that fails before a pipe passes on an empty text, which must not remove the program.
TEST_F(Mistakes, AnEmptyProgramIsRefused) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  folder_.write("some.lst", "Out 4 1\nEND\n");
  folder_.write("empty.lst", " \n\n");
  ASSERT_EQ(daemon.ctl({"program", "device", at("some.lst")}).exit_code, 0);
  const std::string before = daemon.ctl({"program", "device"}).output;
  const Finished piped = run({"/bin/sh", "-c", "exec \"$0\" ctl --control \"$1\" program device - </dev/null",
                              UNDERSTUDY_BINARY, daemon.control()});
  EXPECT_EQ(piped.exit_code, 2);
  EXPECT_EQ(piped.errors, "understudy: ctl program: standard input is empty; expected a listing\n");
  const Finished read = daemon.ctl({"program", "device", at("empty.lst")});
  EXPECT_EQ(read.exit_code, 2);
  EXPECT_EQ(read.errors, "understudy: ctl program: " + at("empty.lst") + ": is empty; expected a listing\n");
  EXPECT_EQ(daemon.ctl({"program", "device"}).output, before);
}

TEST_F(Mistakes, OfTheKindOfAFileNameWhatItIs) {
  folder_.write("bench.yaml",
                "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n");
  folder_.write("day.yaml", "understudy: 1\nname: day\nbench: bench.yaml\nsteps: [ advance: 1ms ]\n");
  folder_.write("model.yaml", "understudy: 1\nmodel: mine\nregisters: list.csv\n");
  folder_.write("list.csv", "address,name\n1,SPEED\n");
  ASSERT_EQ(understudy({"run", at("day.yaml"), "--record", at("kept"), "--trace", at("kept")}).exit_code, 0);
  fs::rename(at("kept/day.jsonl"), at("day.jsonl"));
  fs::rename(at("kept/day.csv"), at("day.csv"));
  const std::string benches = "`understudy: 1` and `lines:`";
  const std::string scenarios = "`understudy: 1`, `bench:` and `steps:`";
  expect_all({
      {{"replay", "@day.yaml"}, 2, "@day.yaml:1: recording: is a scenario; expected a recording"},
      {{"replay", "@bench.yaml"}, 2, "@bench.yaml:1: recording: is a bench; expected a recording"},
      {{"replay", "@day.csv"}, 2, "@day.csv:1: recording: is a trace; expected a recording"},
      {{"replay", "@model.yaml"}, 2, "@model.yaml:1: recording: is a model file; expected a recording"},
      {{"serve", "@day.jsonl"}, 2, "@day.jsonl:1:1: bench: is a recording; expected " + benches},
      {{"serve", "@day.csv"}, 2, "@day.csv:1:1: bench: is a trace; expected " + benches},
      {{"serve", "@day.yaml"},
       2,
       "@day.yaml:1:1: bench: is a scenario; expected a bench (`understudy run` runs scenarios)"},
      {{"serve", "@model.yaml"},
       2,
       "@model.yaml:1:1: bench: is a model file; expected a bench, whose stations name it"},
      {{"run", "@bench.yaml"},
       2,
       "@bench.yaml:1:1: scenario: is a bench; expected a scenario (`understudy serve` serves benches)"},
      {{"run", "@day.jsonl"}, 2, "@day.jsonl:1:1: scenario: is a recording; expected " + scenarios},
      {{"run", "@model.yaml"},
       2,
       "@model.yaml:1:1: scenario: is a model file; expected a scenario, with a bench whose stations name "
       "it"},
      {{"describe", "@bench.yaml", "registers"},
       2,
       "@bench.yaml:1:1: model: is a bench; expected a model file"},
      {{"import", "@bench.yaml"}, 2, "@bench.yaml:1:1: registers: is a bench; expected a list of registers"},
      {{"import", "@day.jsonl"},
       2,
       "@day.jsonl:1:1: registers: is a recording; expected a list of registers"},
      {{"asm", "@bench.yaml"}, 2, "@bench.yaml:1: is a bench; expected a program"},
      {{"plot", "@list.csv"},
       2,
       "@list.csv:1: is not a trace; expected a first line that begins with time_ms"},
  });
  const RunningUnderstudy daemon({"--speed", "manual"});
  expect_all_of(daemon,
                {
                    {{"restore", "@bench.yaml"},
                     2,
                     "understudy: ctl restore: @bench.yaml: file: is a bench; expected a snapshot"},
                    {{"restore", "@day.jsonl"},
                     2,
                     "understudy: ctl restore: @day.jsonl: file: is a recording; expected a snapshot"},
                    {{"program", "device", "@day.yaml"},
                     2,
                     "understudy: ctl program: @day.yaml: is a scenario; expected a program"},
                });
}

TEST_F(Mistakes, OfAModelFilesConditionsSayWhatIsMeant) {
  folder_.write("list.csv", "address,name,access\n1,COMMAND,R/W\n2,TARGET,R/W\n3,SPEED,R/W\n4,POSITION,R\n");
  const auto model = [](const std::string& start) {
    return "understudy: 1\nmodel: mine\nregisters: list.csv\naxes:\n  A:\n    start: " + start +
           "\n    target: TARGET\n    speed: SPEED\n";
  };
  for (const auto& [start, says] : std::vector<std::pair<std::string, std::string>>{
           {"COMMAND = 1", "'=' is not an operator; expected '==' to compare"},
           {"COMMAND=1", "'=' is not an operator; expected '==' to compare"},
           {"COMMAND==1", "'==' has no spaces around it; expected spaces, as in COMMAND == 2"},
           {"COMMAND > 1",
            "'>' is not allowed here; expected a name, or a name and a number, as in COMMAND == 2"},
           {"COMAND", "no register is called 'COMAND'; the nearest is 'COMMAND'"}}) {
    folder_.write("model.yaml", model(start));
    const Finished finished = understudy({"check", at("model.yaml")});
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_NE((finished.errors + finished.output).find(says), std::string::npos)
        << start << ": " << finished.errors << finished.output;
  }
}

TEST_F(Mistakes, OfAddressesAsModiconCountsAreRemarked) {
  struct List {
    std::string text;
    bool is_remarked;
  };
  int number = 0;
  for (const List& list : std::vector<List>{{"address,name\n40001,A\n40002,B\n", true},
                                            {"address,name,table\n40001,A,holding\n30001,B,input\n", true},
                                            {"address,name,table\n40001,A,holding\n1,B,coil\n", true},
                                            {"address,name\n40001,A\n2,B\n", true},
                                            {"address,name\n40000,A\n40001,B\n", false},
                                            {"address,name,table\n30001,A,holding\n", false},
                                            {"address,name,table\n1,A,coil\n", false}}) {
    const std::string name = "list" + std::to_string(++number);
    folder_.write(name + ".csv", list.text);
    const Finished finished = understudy({"import", at(name + ".csv")});
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    const std::string message = finished.errors + finished.output;
    EXPECT_EQ(message.find("read as Modicon numbers: '40001' is 0 on the wire") != std::string::npos,
              list.is_remarked)
        << list.text << message;
  }
}

TEST_F(Mistakes, OfAPageWithoutADaemonAreReportedAtOnce) {
  Process page({UNDERSTUDY_BINARY, "page", "--control", at("nosuch")});
  EXPECT_TRUE(eventually([&] { return page.output().starts_with("page http"); }));
  EXPECT_EQ(page.errors(), "understudy: page: " + at("nosuch") +
                               ": no daemon answers there yet; the page shows the bench when one does\n");
}

TEST_F(Mistakes, OfAScopeAreReportedInWords) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  EXPECT_EQ(daemon.ctl({"scope"}).output, "no scope is armed; ctl scope NAME... when=CONDITION arms one\n");
  EXPECT_EQ(daemon.ctl({"scope", "A.pulses", "Cord_A", "when=Cord_A > 5", "before=2ms", "after=2ms"}).output,
            "armed: A.pulses, Cord_A; waits for Cord_A > 5; 0 ticks recorded\n");
  EXPECT_EQ(daemon.ctl({"set", "Aaxis_SVON=1", "Aaxis_Speed=200", "Aaxis_Pulse=3200"}).exit_code, 0);
  EXPECT_EQ(daemon.ctl({"set", "Aaxis_Move_INC=1"}).exit_code, 0);
  EXPECT_EQ(daemon.ctl({"advance", "1s"}).exit_code, 0);
  const Finished reported = daemon.ctl({"scope"});
  EXPECT_TRUE(reported.output.starts_with("done: A.pulses, Cord_A; 5 ticks recorded, from "))
      << reported.output;
  const Finished written = daemon.ctl({"scope", "--trace", at("shot.csv")});
  EXPECT_EQ(written.output, at("shot.csv") + ": 5 ticks\n") << written.errors;
  std::ifstream shot(at("shot.csv"));
  std::string line;
  std::vector<std::string> lines;
  while (std::getline(shot, line)) lines.push_back(line);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[0], "time_ms,A.pulses,Cord_A");
  EXPECT_EQ(understudy({"plot", at("shot.csv")}).exit_code, 0);
}

}  // namespace mistakes_test
}  // namespace understudy::acceptance
