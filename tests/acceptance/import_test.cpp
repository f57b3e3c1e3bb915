// A user's own controllers: the page as printed, the examples, and real hosts.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace import_test {

namespace fs = std::filesystem;

const std::string kExamples = std::string(PROJECT_FOLDER) + "/examples/import/";

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

Environment with_understudy() {
  const char* const path = std::getenv("PATH");
  const std::string programs = fs::path(UNDERSTUDY_BINARY).parent_path().string();
  return {{"PATH", programs + ":" + (path == nullptr ? "/usr/bin:/bin" : path)}};
}

bool has_mbpoll() { return run({"mbpoll", "-V"}).exit_code != 127; }

TEST(ImportPage, CanBePasted) {
  if (!has_mbpoll()) GTEST_SKIP() << "mbpoll is not installed";
  const PrivateFolder folder;
  const std::string page = contents(std::string(PROJECT_FOLDER) + "/docs/import.md");
  std::string output;
  int blocks = 0;
  const std::string begin = "```sh\n";
  for (std::size_t at = 0; (at = page.find(begin, at)) != std::string::npos; ++blocks) {
    at += begin.size();
    const std::string block = page.substr(at, page.find("```\n", at) - at);
    const Finished pasted = run({"sh", "-ec", "cd " + folder.path() + "\n" + block}, with_understudy());
    ASSERT_EQ(pasted.exit_code, 0) << block << pasted.output << pasted.errors;
    output += pasted.output;
  }
  EXPECT_EQ(blocks, 7);
  EXPECT_NE(output.find("feeder.csv: 6 registers (6 holding)"), std::string::npos) << output;
  EXPECT_NE(output.find("RAMP 300"), std::string::npos) << output;
  EXPECT_NE(output.find("feeder.yaml: a model with 6 registers and 1 axis"), std::string::npos) << output;
  EXPECT_NE(output.find("1 passed, 0 failed"), std::string::npos) << output;
  EXPECT_TRUE(std::regex_search(output, std::regex("\\[6\\]:\\s*5000"))) << output;
}

TEST(ImportExamples, PassTheirOwnScenarios) {
  const Finished played = understudy({"run", kExamples + "scenarios"});
  EXPECT_EQ(played.exit_code, 0) << played.output << played.errors;
  EXPECT_NE(played.output.find("4 passed, 0 failed"), std::string::npos) << played.output;
  EXPECT_EQ(understudy({"check", kExamples}).exit_code, 0);
}

TEST(ImportExamples, PassByTheWallClockAsWell) {
  const Finished played = understudy({"run", "--real-time", kExamples + "scenarios/drive_power.yaml",
                                      kExamples + "scenarios/drive_alarm.yaml"});
  EXPECT_EQ(played.exit_code, 0) << played.output << played.errors;
}

/// A bench of the examples, with links in the test's folder.
std::unique_ptr<RunningUnderstudy> serve_example(const std::string& name, int baud) {
  return RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n  line:\n    link: port\n    baud: " + std::to_string(baud) +
      "\n    stations:\n      - { name: " + name + ", model: " + kExamples + name + ".yaml, address: 1 }\n" +
      (name == "oven" ? "inputs: { oven.ROOM_SENSOR: 200 }\n" : ""));
}

TEST(ImportedDrive, IsDrivenByMbpoll) {
  if (!has_mbpoll()) GTEST_SKIP() << "mbpoll is not installed";
  const auto daemon = serve_example("drive", 115200);
  const auto mbpoll = [&](const std::string& type, int address, const Words& values) {
    Words words{"mbpoll", "-m", "rtu", "-b", "115200", "-P", "none",
                "-0",     "-q", "-B",  "-t", type,     "-r", std::to_string(address)};
    if (values.empty()) words.emplace_back("-1");
    words.push_back(daemon->port());
    if (!values.empty()) words.emplace_back("--");
    words.insert(words.end(), values.begin(), values.end());
    return run(words);
  };
  const auto value = [&](const std::string& type, int address) {
    const Finished finished = mbpoll(type, address, {});
    std::smatch found;
    return std::regex_search(finished.output, found, std::regex("\\]:\\s*(\\S+)")) ? found[1].str()
                                                                                   : finished.errors;
  };
  EXPECT_EQ(value("4", 0x14), "50");
  EXPECT_EQ(mbpoll("4", 0x14, {"100", "50", "50"}).exit_code, 0);  // SPEED, ACC_TIME, DEC_TIME
  EXPECT_EQ(mbpoll("4:int", 0x10, {"-3000"}).exit_code, 0);        // TARGET, the high word first
  EXPECT_NE(mbpoll("4", 0, {"2"}).exit_code, 0) << "without ENABLE";
  EXPECT_EQ(mbpoll("4", 0, {"1"}).exit_code, 0);
  EXPECT_EQ(mbpoll("4", 0, {"3"}).exit_code, 0);
  EXPECT_TRUE(eventually([&] { return value("4:hex", 1) == "0x0005"; })) << value("4:hex", 1);
  EXPECT_EQ(value("4:int", 0x20), "-3000");
  EXPECT_EQ(value("1", 3), "0");  // DRIVE_ALARM
  EXPECT_EQ(daemon->ctl({"input", "drive.ALARM=1"}).exit_code, 0);
  EXPECT_TRUE(eventually([&] { return value("1", 3) == "1"; }));
  EXPECT_EQ(daemon->ctl({"get", "drive.POSITION", "drive.X.pulses"}).output,
            "drive.POSITION -3000\ndrive.X.pulses -12000\n");
  EXPECT_EQ(daemon->errors(), "");
}

class ImportedWithPymodbus : public testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(ImportedWithPymodbus, IsWhatItsHostExpects) {
  for (const char* const module : {"pymodbus", "serial"}) {
    if (!fs::exists(std::string("/usr/lib/python3/dist-packages/") + module))
      GTEST_SKIP() << "python3-" << module << " is not installed";
  }
  const auto [name, baud] = GetParam();
  const auto daemon = serve_example(name, baud);
  const Finished host = run({"/usr/bin/python3", std::string(TEST_FACTS) + "/hosts/imported_host.py",
                             daemon->port(), std::to_string(baud), name});
  EXPECT_EQ(host.exit_code, 0) << host.output << host.errors;
  EXPECT_EQ(daemon->errors(), "");
}

INSTANTIATE_TEST_SUITE_P(, ImportedWithPymodbus,
                         testing::Values(std::pair("drive", 19200), std::pair("oven", 19200)));

/// A folder with a controller that speaks Modbus ASCII, and a scenario for it.
void write_ascii_model(const std::string& folder) {
  std::ofstream(folder + "/m.yaml") << "understudy: 1\nmodel: m\nline: { framing: ascii }\nregisters: |\n"
                                       "  address,name,min,max\n  0,A,0,100\n  1,B,0,100\n  100~224,X,,\n";
  std::ofstream(folder + "/b.yaml")
      << "understudy: 1\nlines:\n  a: { link: port, stations: [ { name: it, model: "
         "m.yaml, address: 17 } ] }\n";
  std::ofstream(folder + "/s.yaml")
      << "understudy: 1\nname: ascii\nbench: b.yaml\nsteps:\n"
         "  - write: { it.B: 42 }\n  - wait: { until: it.B == 42, poll: 20ms, within: 1s }\n"
         "  - write: { it.B: 101 }\n    exception: 3\n";
}

TEST(ImportedAscii, IsDrivenByPymodbus) {
  if (!fs::exists("/usr/lib/python3/dist-packages/pymodbus"))
    GTEST_SKIP() << "python3-pymodbus is not installed";
  const PrivateFolder folder;
  write_ascii_model(folder.path());
  const auto daemon = RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n  a: { link: port, stations: [ { name: it, model: " + folder.path() +
      "/m.yaml, address: 17 } ] }\n");
  const Finished host = run({"/usr/bin/python3", std::string(TEST_FACTS) + "/hosts/imported_host.py",
                             daemon->port(), "19200", "ascii"});
  EXPECT_EQ(host.exit_code, 0) << host.output << host.errors;
  EXPECT_EQ(daemon->errors(), "");
  const std::string frames = daemon->ctl({"frames", "--once"}).output;
  EXPECT_NE(frames.find("write 0x0000 it.A = 101"), std::string::npos) << frames;
  EXPECT_NE(frames.find("exception 3"), std::string::npos) << frames;
}

TEST(ImportedAscii, PlaysItsScenariosInBothTimes) {
  const PrivateFolder folder;
  write_ascii_model(folder.path());
  for (const Words& flags : {Words{"run"}, Words{"run", "--real-time"}}) {
    Words words = flags;
    words.push_back(folder.path() + "/s.yaml");
    const Finished played = understudy(words);
    EXPECT_EQ(played.exit_code, 0) << played.output << played.errors;
  }
  const Finished polled = understudy({"poll", "nowhere", "--model", folder.path() + "/m.yaml", "A"});
  EXPECT_EQ(polled.exit_code, 2);
  EXPECT_NE(polled.errors.find("m speaks Modbus ASCII, but poll supports only Modbus RTU"), std::string::npos)
      << polled.errors;
}

TEST(ImportedModels, AreInTheirRecordings) {
  const PrivateFolder folder;
  fs::copy(kExamples, folder.path(), fs::copy_options::recursive);
  const Finished played =
      understudy({"run", "--record", folder / "recordings", folder / "scenarios/drive.yaml"});
  ASSERT_EQ(played.exit_code, 0) << played.errors;
  std::string recording;
  for (const auto& entry : fs::directory_iterator(folder / "recordings")) recording = entry.path().string();
  const PrivateFolder elsewhere;
  fs::rename(recording, elsewhere / "drive.jsonl");
  fs::remove_all(folder.path());
  const Finished replayed =
      understudy({"replay", elsewhere / "drive.jsonl", "--trace", elsewhere / "drive.csv"});
  EXPECT_EQ(replayed.exit_code, 0) << replayed.output << replayed.errors;
  EXPECT_NE(contents(elsewhere / "drive.csv").find("drive.POSITION"), std::string::npos);
}

TEST(ImportedModels, KeepTheirMemoriesInFiles) {
  const PrivateFolder memories;
  const std::string model = kExamples + "drive.yaml";
  {
    const auto daemon = RunningUnderstudy::of_model(model, {"--nv", memories.path()});
    EXPECT_EQ(daemon->ctl({"set", "device.ACC_TIME=321"}).exit_code, 0);
  }
  EXPECT_NE(contents(memories / "device.json").find("\"ACC_TIME\": 321"), std::string::npos)
      << contents(memories / "device.json");
  const auto daemon = RunningUnderstudy::of_model(model, {"--nv", memories.path()});
  EXPECT_EQ(daemon->ctl({"get", "device.ACC_TIME", "device.SPEED"}).output,
            "device.ACC_TIME 321\ndevice.SPEED 50\n");
}

TEST(ImportedModels, AreNotWrittenOver) {
  const PrivateFolder folder;
  fs::copy(kExamples + "drive.csv", folder / "drive.csv");
  fs::copy(kExamples + "drive.yaml", folder / "drive.yaml");
  for (const char* const name : {"drive.csv", "drive.yaml"}) {
    const Finished refused = understudy(
        {"serve", "--model", folder / "drive.yaml", "--record", folder / name, "--link", folder / "port"});
    EXPECT_EQ(refused.exit_code, 2) << refused.errors;
    EXPECT_NE(refused.errors.find("expected another path"), std::string::npos) << refused.errors;
  }
}

TEST(ImportCommand, WritesWhatCanBeServedAndNothingOver) {
  const PrivateFolder folder;
  const std::string list = folder.write("a pump.csv", "address,name,default\n0,X,7\n");
  const Finished made = understudy({"import", list});
  EXPECT_EQ(made.exit_code, 0) << made.errors;
  EXPECT_EQ(lines_of(made.output).at(0), list + ": 1 register (1 holding)");
  EXPECT_EQ(understudy({"check", folder.path()}).exit_code, 0);
  EXPECT_EQ(understudy({"describe", folder / "a-pump.yaml", "registers", "--format", "csv"}).output,
            "table,address,name,access,width,signed,min,max,unit,persistent,default\n"
            "holding,0x0000,X,R/W,16,0,,,,0,7\n");
  const std::string before = contents(folder / "a-pump.yaml");
  const Finished again = understudy({"import", list});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_EQ(again.errors, folder / "a-pump.yaml: file: already exists; expected a folder without it\n");
  EXPECT_EQ(contents(folder / "a-pump.yaml"), before);
  // In another folder, and under another name.
  fs::create_directory(folder / "models");
  EXPECT_EQ(understudy({"import", list, "-o", folder / "models/p.yaml", "--name", "pump"}).exit_code, 0);
  EXPECT_EQ(understudy({"check", folder / "models"}).exit_code, 0);
  EXPECT_NE(contents(folder / "models/p.yaml").find("registers: '../a pump.csv'"), std::string::npos);
}

TEST(ImportCommand, UsesTheGivenSettings) {
  const PrivateFolder folder;
  const std::string list = folder.write("p.csv", "Where,What,Role\n40069,X,1\n");
  const Finished unclear = understudy({"import", list, "--columns", "address=Where,name=B"});
  EXPECT_EQ(unclear.exit_code, 2);
  EXPECT_NE(unclear.errors.find("expected --addresses modicon, or --addresses wire"), std::string::npos)
      << unclear.errors;
  const Finished reported =
      understudy({"import", list, "--columns", "address=Where,name=B", "--addresses", "modicon"});
  EXPECT_EQ(reported.exit_code, 0) << reported.errors;
  EXPECT_NE(reported.errors.find(":1:12: columns: ignored: Role; "), std::string::npos) << reported.errors;
  const Finished checked = understudy({"check", folder / "p.yaml"});
  EXPECT_EQ(checked.exit_code, 0) << checked.errors;
  EXPECT_NE((checked.output + checked.errors).find("warning: columns: ignored: Role"), std::string::npos)
      << checked.output << checked.errors;
  const std::string registers = understudy({"describe", folder / "p.yaml", "registers"}).output;
  EXPECT_NE(registers.find("0x0044"), std::string::npos) << registers;
  EXPECT_NE(registers.find("40069"), std::string::npos) << registers;
}

/// A row that begins with a number and ends in two hexadecimal digits looks like one of a logic analyser.
TEST(ImportCommand, TakesListsWhoseRowsLookLikeThoseOfCaptures) {
  for (const char* const text :
       {"address,name,default\n0,SPEED,50\n1,RAMP,200\n", "address,name,width\n0,SPEED,16\n1,RAMP,32\n",
        "Register,Parameter,Default\n101,P0.02,50\n", "address,name,min,max\n0,F,0,10\n1,AB,0,10\n"}) {
    const PrivateFolder folder;
    const Finished imported = understudy({"import", folder.write("p.csv", text)});
    EXPECT_EQ(imported.exit_code, 0) << text << imported.errors;
  }
  const PrivateFolder folder;
  const Finished refused =
      understudy({"import", folder.write("p.csv", "Time [s],Value,Error\n0.001,01,\n0.002,03,\n")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("is a table of Saleae Logic, for `understudy compare`"), std::string::npos)
      << refused.errors;
}

TEST(ImportCommand, RefusesWhatCannotBeOne) {
  const PrivateFolder folder;
  const std::string list = folder.write("p.csv", "address,name\n0,X\n");
  const auto diagnostic = [](const Words& words) {
    const Finished refused = understudy(words);
    EXPECT_EQ(refused.exit_code, 2) << refused.output;
    return refused.errors;
  };
  EXPECT_EQ(diagnostic({"import", folder / "q.csv"}),
            folder /
                "q.csv: registers: cannot be read (No such file or directory); expected a list of registers "
                "(CSV)\n");
  EXPECT_EQ(diagnostic({"import", list, "--name", "a b"}),
            "understudy: --name: 'a b' is not a name; expected letters, digits, _ and -\n");
  EXPECT_EQ(diagnostic({"import", list, "--name", "slim"}),
            "understudy: --name: 'slim' is the name of an existing model; expected another name\n");
  EXPECT_EQ(diagnostic({"import", list, "--columns", "adress=A"}),
            "understudy: --columns: 'adress' is not a column; the nearest is 'address'\n");
  EXPECT_EQ(diagnostic({"import", list, "--addresses", "modbus"}),
            "understudy: --addresses: 'modbus' is not valid; expected one of wire, from_one, modicon\n");
  EXPECT_EQ(diagnostic({"import", list, "--table", "coils"}),
            "understudy: --table: 'coils' is not valid; expected one of holding, input, coil, discrete\n");
  EXPECT_EQ(diagnostic({"import", list, "--encoding", "ebcdic"}),
            "understudy: --encoding: 'ebcdic' is not valid; expected one of utf-8, utf-16, latin-1, big5, "
            "gbk\n");
  EXPECT_EQ(diagnostic({"import", list, "-o", "p.txt"}),
            "understudy: --output: 'p.txt' does not end in .yaml; expected a model file\n");
  EXPECT_EQ(diagnostic({"serve", "--model", folder / "none.yaml"}),
            folder / "none.yaml: model: cannot be read (No such file or directory); expected a model file\n");
  const std::string wrong = folder.write("w.yaml", "understudy: 1\nmodel: w\nregisters: p.csv\naxis: {}\n");
  EXPECT_NE(diagnostic({"check", wrong}).find(wrong + ":4:7: axis: is not a key here; expected one of"),
            std::string::npos);
  EXPECT_EQ(fs::exists(folder / "p.yaml"), false);
}

}  // namespace import_test
}  // namespace understudy::acceptance
