// The report as a browser and a reader see it: complete in one file, well formed, with the failure at its
// moment.
#include "emulator/play/report/page.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "emulator/play/report/run_logger.h"
#include "tests/emulator/play/performing/played.h"
#include "tests/sanitized.h"

namespace understudy::emulator::play {
namespace page_test {

RunOptions filmed() {
  RunOptions options;
  options.observers.push_back([](world::World& world) { return std::make_unique<RunLogger>(world); });
  return options;
}

std::string page_of(const std::string& steps) {
  return report_page(run_scenario(scenario_of(steps), filmed()), "1.2.3");
}

/// Reports the errors of a page: tags that do not match, names used twice, links that lead nowhere; and what
/// users of a screen reader would miss: landmarks, headings in order, names of pictures, the scope of table
/// headers.
constexpr const char* kReader = R"(
import sys, html.parser
class Reader(html.parser.HTMLParser):
    open, names, links, seen, level = [], [], [], [], 0
    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.seen.append(tag)
        if tag in ('h1', 'h2', 'h3'):
            if int(tag[1]) > self.level + 1: print('a heading is left out before', tag, self.getpos())
            self.level = int(tag[1])
        if tag == 'th' and given.get('scope') not in ('col', 'row'): print('a head of what?', self.getpos())
        if given.get('role') in ('img', 'group') and not given.get('aria-label'):
            print('has no name:', tag, self.getpos())
        if tag == 'svg':
            if given.get('role') != 'img': print('is no picture', self.getpos())
            if self.open[-1] != 'div': print('cannot be scrolled', self.getpos())
        for name, value in attributes:
            if name == 'id': self.names.append(value)
            if name == 'href': self.links.append(value)
        if tag not in ('meta', 'br'): self.open.append(tag)
    def handle_startendtag(self, tag, attributes): pass
    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag: print('unexpected end of', tag, self.getpos())
reader = Reader()
reader.feed(open(sys.argv[1], encoding='utf-8').read())
reader.close()
if reader.open: print('left open:', reader.open)
for once in ('h1', 'header', 'nav', 'main', 'footer'):
    if reader.seen.count(once) != 1: print(reader.seen.count(once), 'times', once)
if reader.seen.count('svg') != reader.seen.count('desc'): print('a picture is not described')
if len(set(reader.names)) != len(reader.names): print('names used twice')
for link in reader.links:
    if link[:1] != '#' or link[1:] not in reader.names: print('leads nowhere:', link)
)";

std::string diagnostics_of_a_parser(const std::string& page) {
  const std::string file = testing::TempDir() + "understudy-page" + std::to_string(getpid()) + ".html";
  const std::string script = file + ".py";
  std::ofstream(file) << page;
  std::ofstream(script) << kReader;
  std::string output;
  if (FILE* const pipe = popen(("python3 " + script + " " + file + " 2>&1").c_str(), "r")) {
    for (int c = 0; (c = fgetc(pipe)) != EOF;) output += static_cast<char>(c);
    pclose(pipe);
  } else {
    return "python3 does not run";
  }
  std::filesystem::remove(file);
  std::filesystem::remove(script);
  return output;
}

const std::string kDay =
    kServoOn + "  - snapshot: on\n" + kExampleMove +
    "  - wait: { until: feeder.STATUS.4 == 0, within: 4s, poll: 50ms }\n"
    "  - restore: on\n"
    "  - input: { feeder.DIN_10: on, feeder.AIN_A: 1V }\n"
    "  - send: { bytes: 01 03 00, reply: nothing, within: 20ms }\n"
    "  - fork: { well: [ advance: 5ms ], ill: [ advance: 5ms, assert: feeder.DIN_10 == 0 ] }\n";

TEST(ReportPage, IsWellFormedWhateverHasHappened) {
  EXPECT_EQ(diagnostics_of_a_parser(page_of(kDay)), "");
  EXPECT_EQ(diagnostics_of_a_parser(page_of("  - assert: 1 == 2\n" + kDay)), "");
  EXPECT_EQ(diagnostics_of_a_parser(report_page({}, "1.2.3")), "");
  EXPECT_EQ(diagnostics_of_a_parser(report_page(run_scenario(scenario_of(kDay)), "1.2.3")),
            "");  // without a run log
}

TEST(ReportPage, NeedsNothingFromElsewhere) {
  const std::string page = page_of(kDay);
  for (const char* reference : {"http", "src=", "url(", "@import", "<link", "<iframe", "fetch("}) {
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
  }
}

TEST(ReportPage, IsTheSameForEqualPlays) { EXPECT_EQ(page_of(kDay), page_of(kDay)); }

TEST(ReportPage, ShowsNamesAsTheyAre) {
  const ScenarioResult odd{.verdict = ScenarioResult::Verdict::failed,
                           .name = "<script>alert(1)</script> & \"more\"",
                           .file = "a<b>.yaml",
                           .steps = {{"a<b>.yaml", 3, "say </code>", SimTime{0}, SimTime{0}, true}},
                           .failure = Failure{.what = "x < y", .frames = {"<b>"}, .state = {"</pre>"}},
                           .lint_findings = {"<i>"}};
  const std::string page = report_page({&odd, 1}, "1.2.3");
  EXPECT_EQ(diagnostics_of_a_parser(page), "");
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;more&quot;"), std::string::npos);
  EXPECT_NE(page.find("<code>&lt;i&gt;</code>"), std::string::npos);
}

TEST(ReportPage, MarksTheFailingMoment) {
  const std::string page =
      page_of(kServoOn + kExampleMove + "  - never: feeder.A.pulses > 1000\n  - advance: 500ms\n");
  // The run ends there, so the mark is at the end: x = 1085.
  EXPECT_NE(page.find("<line class=\"failure\" x1=\"1085.00\""), std::string::npos);
  EXPECT_NE(page.find("failed at "), std::string::npos);
  const std::string well = page_of(kServoOn + kExampleMove + "  - advance: 500ms\n");
  EXPECT_EQ(well.find("<line class=\"failure\""), std::string::npos);
  EXPECT_EQ(well.find("failed at "), std::string::npos);
}

/// Returns the numbers that follow each `before` on the page.
std::vector<double> numbers_behind(const std::string& page, const std::string& before) {
  std::vector<double> numbers;
  for (std::size_t at = page.find(before); at != std::string::npos; at = page.find(before, at + 1)) {
    numbers.push_back(std::strtod(page.c_str() + at + before.size(), nullptr));
  }
  return numbers;
}

/// Returns the positions of the texts of a kind, from the top of the picture.
std::vector<double> heights_of(const std::string& page, const std::string& kind) {
  std::vector<double> heights;
  const std::string begin = "<text class=\"" + kind + "\"";
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
    heights.push_back(numbers_behind(page.substr(at, page.find('>', at) - at), " y=\"").at(0));
  }
  return heights;
}

TEST(ReportPage, TheFailingMomentCoversNoNumber) {
  constexpr double kLetters = 11;  // how high they are
  std::string steps = kServoOn;
  for (int i = 0; i < 11; ++i) steps += "  - advance: 100ms\n";
  const std::string page = page_of(steps + "  - assert: 1 == 2\n");
  const std::vector<double> label = heights_of(page, "failed end");
  ASSERT_EQ(label.size(), 1U);
  EXPECT_GE(label[0], kLetters) << "it is truncated";
  const std::vector<double> numbers = heights_of(page, "number middle");
  EXPECT_GT(numbers.size(), 8U);
  const std::vector<double> line = numbers_behind(page, "<line class=\"failure\" x1=\"1085.00\" y1=\"");
  ASSERT_EQ(line.size(), 1U);
  for (const double number : numbers) {
    EXPECT_GE(number - kLetters, label[0]) << "the label is over it";
    EXPECT_GT(line[0], number) << "the line is over it";
  }
}

TEST(ReportPage, SaysWhatAPictureShows) {
  const std::string page = page_of(kServoOn + kExampleMove +
                                   "  - input: { feeder.DIN_10: on }\n  - advance: 3200ms\n"
                                   "  - assert: feeder.Cord_A == 1\n");
  EXPECT_NE(page.find("role=\"img\" aria-label=\"test: motion and signals, from 0s to 3."),
            std::string::npos);
  EXPECT_NE(page.find("<desc>feeder.A.position goes from 0 to 32000 pulses, between 0 and 32000; "),
            std::string::npos);
  EXPECT_NE(page.find("; feeder.A.speed goes from 0 to 0 pulses/s, between 0 and 10666.67; "),
            std::string::npos);
  EXPECT_NE(page.find("; feeder.DIN_10 is off at first and on at the end; failed at 3."), std::string::npos);
}

TEST(ReportPage, NamesTheRecordingThatWasKept) {
  std::vector<ScenarioResult> results =
      run_scenario(scenario_of("  - assert: feeder.DIN_10 == 1\n"), filmed());
  EXPECT_EQ(report_page(results, "1.2.3").find("understudy replay"), std::string::npos);
  results.at(0).recording = "/tmp/a&b.jsonl";
  const std::string page = report_page(results, "1.2.3");
  EXPECT_NE(page.find("<p>to run this again: <code>understudy replay /tmp/a&amp;b.jsonl</code></p>"),
            std::string::npos);
  EXPECT_EQ(diagnostics_of_a_parser(page), "");
}

TEST(ReportPage, DrawsWhatMovedWithItsData) {
  const std::string page = page_of(kServoOn + kExampleMove + "  - advance: 3200ms\n");
  // Parsed by hand: the library's regular expressions recurse once per character, and sanitizers give them
  // too little stack.
  const std::size_t curve = page.find("data-name=\"feeder.A.position\" data-base=\"0\"");
  ASSERT_NE(curve, std::string::npos);
  const std::string attribute = " points=\"";
  const std::size_t begin = page.find(attribute, curve) + attribute.size();
  ASSERT_LT(begin, page.find('>', curve)) << "of another element";
  const std::string points = page.substr(begin, page.find('"', begin) - begin);
  EXPECT_TRUE(points.starts_with("0,0 ")) << points.substr(0, 20);
  EXPECT_TRUE(points.ends_with(",32000")) << points.substr(points.size() - 20);
  // The machine has followed, so the pulses show nothing new; B was at rest; no input changed.
  for (const char* name : {"feeder.A.pulses", "feeder.B.position", "feeder.DIN_10"}) {
    EXPECT_EQ(page.find("data-name=\"" + std::string(name)), std::string::npos) << name;
  }
  EXPECT_NE(page.find("data-name=\"feeder.A.speed\""), std::string::npos);
  EXPECT_NE(page.find("position [pulses]"), std::string::npos);
  EXPECT_NE(page.find("speed [pulses/s]"), std::string::npos);
  EXPECT_NE(page.find("simulated time [s]"), std::string::npos);
}

TEST(ReportPage, DrawsTheDutyOfAnAxisThatHasOne) {
  const std::string page = page_of(kServoOn +
                                   "  - write: { feeder.Aaxis_DirectPWM: 40 }\n  - advance: 100ms\n"
                                   "  - write: { feeder.Aaxis_STOP: 1 }\n  - advance: 100ms\n");
  EXPECT_NE(page.find("PWM duty [%]"), std::string::npos);
  EXPECT_NE(page.find("data-name=\"feeder.A.pwm\""), std::string::npos);
  EXPECT_EQ(page.find("data-name=\"feeder.B.pwm\""), std::string::npos) << "it never had one";
  EXPECT_NE(page.find("feeder.A.pwm goes from 0 to 0 %, between 0 and 40"), std::string::npos);
  EXPECT_EQ(page_of(kServoOn + kExampleMove + "  - advance: 500ms\n").find("PWM"), std::string::npos);
}

TEST(ReportPage, DrawsPulsesThatTheMachineDidNotFollow) {
  const std::string page =
      page_of("  - inject: { stall: feeder.A }\n" + kServoOn + kExampleMove + "  - advance: 500ms\n");
  EXPECT_NE(page.find("class=\"line k0 dashed\" data-name=\"feeder.A.pulses\""), std::string::npos);
}

TEST(ReportPage, HasEveryStepWithItsFrames) {
  const std::string page = page_of(kServoOn + kExampleMove + "  - say: the end\n");
  EXPECT_NE(page.find("<code>write feeder.Aaxis_SVON=1</code>"), std::string::npos);
  EXPECT_NE(page.find("<code>write 0x1014 feeder.Aaxis_SVON = 1</code>"), std::string::npos);
  EXPECT_NE(page.find("title=\"0.005333333 s\">0.005333<"), std::string::npos);  // the reply
  EXPECT_NE(page.find("<code>say the end</code>"), std::string::npos);
  std::size_t frames = 0;
  for (std::size_t at = page.find("<summary>2 frames</summary>"); at != std::string::npos;
       at = page.find("<summary>2 frames</summary>", at + 1)) {
    ++frames;
  }
  EXPECT_EQ(frames, 2U);
}

TEST(ReportPage, OfAnHourIsStillSmall) {
  const std::string times = std::to_string(fewer_if_sanitized(100, 10));
  const std::string steps =
      "  - repeat:\n      times: " + times +
      "\n      steps:\n        - write: { feeder.Aaxis_Pulse: 320000, "
      "feeder.Aaxis_Speed: "
      "600, feeder.Aaxis_AccTime: 50, feeder.Aaxis_DecTime: 50, feeder.Aaxis_Move_INC: 1 }\n"
      "        - advance: 36s\n";
  const std::string page = page_of(kServoOn + steps);
  EXPECT_LT(page.size(), 600'000U);
}

TEST(ReportPage, MarksWhatFaultsStruck) {
  const std::string page =
      page_of(kServoOn + "  - inject: { drop: feeder, nth: 1 }\n" +
              "  - send: { bytes: 01 03 00 01 00 01 +crc, reply: nothing, within: 20ms }\n"
              "  - clear: all\n" +
              kExampleMove + "  - wait: { until: feeder.STATUS.4 == 0, within: 4s }\n");
  EXPECT_NE(page.find("<span class=\"bad\">fault 1 drop: not sent</span>"), std::string::npos);
  EXPECT_NE(page.find("rs485: fault 1 drop: not sent</title><line class=\"fault\""), std::string::npos);
  EXPECT_EQ(diagnostics_of_a_parser(page), "");
}

}  // namespace page_test
}  // namespace understudy::emulator::play
