// NV images as text: the contents of a device's memory are read back, and anything else is refused with one
// line and its position.
#include "emulator/device/memory/nv_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "emulator/device/device.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/model.h"
#include "emulator/models/simple2_r3/model.h"
#include "tests/sanitized.h"

namespace understudy::emulator {
namespace nv_image_test {

const NvImage kExample{.model = "simple2-r3",
                       .firmware = "1.52",
                       .registers = {{"ENCA_Resoultion", 2147483648},
                                     {"Parms_Pulse1", -2147483648},
                                     {"Parms_mRPM16", -1},
                                     {"MAIN_LINE0_CMD", 255},
                                     {"PROG_MEM31", 2147483647},
                                     {"Aaxis_SVON_Polarity", 0}}};

/// Returns the error of a text; empty if there is none.
std::string diagnostic(const std::string& text) {
  try {
    parse_nv_image(text);
    return "";
  } catch (const NvError& error) {
    return error.what();
  }
}

/// A file with this in place of its registers.
std::string with_registers(const std::string& registers) {
  return R"({"understudy": 1, "kind": "nv-image", "model": "simple2-r3", "firmware": "1.52", "registers": )" +
         registers + "}";
}

bool is_one_line(const std::string& text) { return !text.empty() && text.find('\n') == std::string::npos; }

TEST(NvImage, IsJsonThatPeopleReadAndCompare) {
  // One register per line, in the given order, and a newline at the end, so that a line-by-line comparison
  // shows what has changed.
  const NvImage small{.model = "m", .firmware = "1.00", .registers = {{"b", 2}, {"a", -1}}};
  EXPECT_EQ(to_json(small),
            "{\n"
            "  \"understudy\": 1,\n"
            "  \"kind\": \"nv-image\",\n"
            "  \"model\": \"m\",\n"
            "  \"firmware\": \"1.00\",\n"
            "  \"registers\": {\n"
            "    \"b\": 2,\n"
            "    \"a\": -1\n"
            "  }\n"
            "}\n");
}

TEST(NvImage, ComesBackAsItWas) {
  for (const NvImage& image : {kExample, NvImage{.model = "m", .firmware = "1.00", .registers = {}}}) {
    EXPECT_EQ(parse_nv_image(to_json(image)), image);
  }
}

TEST(NvImage, MayBeLaidOutInAnyWay) {
  std::string flat = to_json(kExample);
  std::erase(flat, '\n');
  std::erase(flat, ' ');
  EXPECT_EQ(parse_nv_image(flat), kExample);
  EXPECT_EQ(parse_nv_image("\n\t " + flat + "\r\n\n"), kExample);
}

TEST(NvImage, TornAnywhereIsRefusedWithTheLineOfTheTear) {
  const std::string whole = to_json(kExample);
  ASSERT_TRUE(whole.ends_with("}\n"));
  for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
    const std::string torn = whole.substr(0, size);
    const auto line = 1 + std::count(torn.begin(), torn.end(), '\n');
    EXPECT_EQ(diagnostic(torn),
              "line " + std::to_string(line) + ": is damaged or not JSON; expected an NV image")
        << "after " << size << " bytes";
  }
  EXPECT_EQ(parse_nv_image(whole.substr(0, whole.size() - 1)), kExample) << "no part of it is missing";
}

TEST(NvImage, ATailOfAnotherImageBehindItIsRefused) {
  // The contents of a file that was overwritten in place by a shorter image.
  const std::string longer = to_json(kExample);
  NvImage shorter = kExample;
  shorter.registers.resize(2);
  const std::string head = to_json(shorter);
  ASSERT_LT(head.size(), longer.size());
  const std::string mixed = head + longer.substr(head.size());
  EXPECT_NE(diagnostic(mixed).find(": is damaged or not JSON"), std::string::npos) << diagnostic(mixed);
}

TEST(NvImage, OneDamagedByteGivesAnImageOrOneLine) {
  // A digit may become another one, but nothing may end the program.
  const std::string values = std::string("\0\n\x1f \"\\,:{}[]09-+.eEaZ/'\x7f\x80\xC3\xED\xF4\xFF", 29);
  const std::string whole = to_json(kExample);
  std::size_t refused = 0;
  for (std::size_t place = 0; place < whole.size(); ++place) {
    for (const char value : values) {
      std::string damaged = whole;
      damaged[place] = value;
      const std::string wrong = diagnostic(damaged);
      if (wrong.empty()) continue;
      ++refused;
      ASSERT_TRUE(is_one_line(wrong)) << place << " " << int{value} << ": " << wrong;
      ASSERT_NE(wrong.find("; expected "), std::string::npos) << wrong;
    }
  }
  EXPECT_GT(refused, whole.size() * 20);
}

struct Refused {
  const char* what;
  std::string text;
  std::string diagnostic;
};

TEST(NvImage, RefusesWhatIsNoImage) {
  const std::string head = R"({"understudy": 1, "kind": "nv-image", "model": "m", )";
  const Refused cases[] = {
      {"nothing", "", "line 1: is damaged or not JSON; expected an NV image"},
      {"spaces", " \n\n ", "line 3: is damaged or not JSON; expected an NV image"},
      {"YAML", "understudy: 1\nlines: {}\n", "line 1: is damaged or not JSON; expected an NV image"},
      {"zero bytes", std::string(4096, '\0'), "line 1: is damaged or not JSON; expected an NV image"},
      {"no Unicode", with_registers("{\"\xff\xfe\": 1}"),
       "line 1: is damaged or not JSON; expected an NV image"},
      {"two images", to_json(kExample) + to_json(kExample),
       "line 15: is damaged or not JSON; expected an NV image"},
      {"a list", "[]", "understudy: is missing; expected an NV image"},
      {"a number", "7", "understudy: is missing; expected an NV image"},
      {"null", "null", "understudy: is missing; expected an NV image"},
      {"somebody else's JSON", R"({"version": 3, "registers": {}})",
       "understudy: is missing; expected an NV image"},
      {"a later format", R"({"understudy": 2})", "understudy: has a different format; expected 1"},
      {"a format in words", R"({"understudy": "1"})", "understudy: has a different format; expected 1"},
      {"a format with a point", R"({"understudy": 1.0})", "understudy: has a different format; expected 1"},
      {"a format of yes", R"({"understudy": true})", "understudy: has a different format; expected 1"},
      {"no kind", R"({"understudy": 1})", "kind: is missing; expected an NV image"},
      {"another kind", R"({"understudy": 1, "kind": "recording"})",
       "kind: is 'recording'; expected nv-image"},
      {"a kind of number", R"({"understudy": 1, "kind": 3})", "kind: is not text; expected an NV image"},
      {"no model", R"({"understudy": 1, "kind": "nv-image"})", "model: is missing; expected an NV image"},
      {"a model of null", R"({"understudy": 1, "kind": "nv-image", "model": null})",
       "model: is not text; expected an NV image"},
      {"no firmware", head + R"("registers": {}})", "firmware: is missing; expected an NV image"},
      {"a firmware of number", head + R"("firmware": 1.52, "registers": {}})",
       "firmware: is not text; expected an NV image"},
      {"no registers", head + R"("firmware": "1.52"})", "registers: is missing; expected an NV image"},
      {"a list of registers", with_registers("[1, 2]"),
       "registers: is not an object; expected names and values"},
      {"an unknown key", head + R"("firmware": "1.52", "registers": {}, "extra": 1})",
       "'extra': is not a key of an NV image; expected none"},
      {"a key twice", R"({"understudy": 1, "understudy": 1})",
       "line 1: 'understudy': appears twice; expected it only once"},
      {"a register twice", with_registers(R"({"A": 1, "B": 2, "A": 1})"),
       "line 1: 'A': appears twice; expected it only once"},
      {"a list of kinds of blocks",
       head + R"("firmware": "1.52", "registers": {}, "blocks": [{"files": {}}]})",
       "blocks: is not an object; expected kinds of blocks"},
      {"a list of blocks, cut off", R"({"blocks": [{"files": {"f1": "a)",
       "line 1: is damaged or not JSON; expected an NV image"},
      {"a key with a newline, twice", R"({"a\nb": 1, "a\nb": 1})",
       "'a?b': appears twice; expected it only once"},
  };
  for (const Refused& c : cases) {
    const std::string found = diagnostic(c.text);
    EXPECT_TRUE(is_one_line(found)) << c.what << ": " << found;
    if (std::string(c.what).find("newline") == std::string::npos) {
      EXPECT_EQ(found, c.diagnostic) << c.what;
    }
  }
}

TEST(NvImage, HoldsRealNumbersAndAProgram) {
  // A line in UTF-8 is stored as text, a line in another encoding (Big5 here: 5C is its second byte) as a
  // list of its bytes.
  const NvImage image{.model = "slim",
                      .firmware = "1.00",
                      .registers = {},
                      .reals = {{"PR3", 55.5}, {"RS(2000)", -1e-30}, {"R0", 0.1}},
                      .program = {"MA 5", "OUT \"完成 \\ \"", "OUT \"\xA7\xB9\xA6\x5C\"", "", "\xFF"}};
  const std::string text = to_json(image);
  EXPECT_EQ(parse_nv_image(text), image);
  EXPECT_NE(text.find("\"MA 5\",\n"), std::string::npos) << text;
  EXPECT_NE(text.find("完成"), std::string::npos) << text;
  const std::string head = R"({"understudy": 1, "kind": "nv-image", "model": "m", "firmware": "1.52", )";
  const auto program = [&](const std::string& lines) {
    return diagnostic(head + R"("registers": {}, "program": )" + lines + "}");
  };
  EXPECT_EQ(program(R"(["MA 5", [77, 65, 32, 53]])"), "");
  for (const char* lines :
       {"7", "{}", "[7]", "[[256]]", "[[-1]]", "[[1.5]]", R"([["M"]])", "null", "[null]"}) {
    EXPECT_EQ(program(lines), "program: is not a list of lines; expected one") << lines;
  }
  const auto reals = [&](const std::string& values) {
    return diagnostic(head + R"("registers": {}, "reals": )" + values + "}");
  };
  EXPECT_EQ(reals("[1]"), "reals: is not an object; expected names and values");
  EXPECT_EQ(reals(R"({"R0": "1"})"), "reals: 'R0': is not a number; expected one");
  EXPECT_EQ(reals(R"({"R0": 1e999})"), "a number is too large; expected one that fits in 64 bits");
  EXPECT_EQ(reals(R"({"R0": 1, "R0": 2})"), "line 1: 'R0': appears twice; expected it only once");
}

TEST(NvImage, TakesWholeNumbersOf64BitsOnly) {
  EXPECT_EQ(
      parse_nv_image(with_registers(R"({"a": -9223372036854775808, "b": 9223372036854775807})")).registers,
      (std::vector<std::pair<std::string, std::int64_t>>{{"a", INT64_MIN}, {"b", INT64_MAX}}));
  for (const char* value : {"1.0", "1e3", "0.5", "-0.0", "9223372036854775808", "18446744073709551616",
                            "-9223372036854775809", "\"1\"", "null", "true", "[1]", "{}"}) {
    EXPECT_EQ(diagnostic(with_registers(std::string("{\"a\": ") + value + "}")),
              "registers: 'a': is not a whole number; expected one")
        << value;
  }
  for (const char* value : {"1e999", "-1e999"}) {
    EXPECT_EQ(diagnostic(with_registers(std::string("{\"a\": ") + value + "}")),
              "a number is too large; expected one that fits in 64 bits")
        << value;
  }
  for (const char* value : {"01", "+1", "0x10", "1_000", "NaN", ".5", "--1", "1 2"}) {
    EXPECT_EQ(diagnostic(with_registers(std::string("{\"a\": ") + value + "}")),
              "line 1: is damaged or not JSON; expected an NV image")
        << value;
  }
}

TEST(NvImage, IsNotBroughtDownByItsSize) {
  const auto deep = fewer_if_sanitized<std::size_t>(300'000, 10);
  std::string nest;
  for (std::size_t i = 0; i < deep; ++i) nest += "{\"a\":";
  nest += "1" + std::string(deep, '}');
  EXPECT_EQ(diagnostic(nest), "understudy: is missing; expected an NV image");
  EXPECT_EQ(diagnostic(with_registers(std::string(deep, '[') + std::string(deep, ']'))),
            "registers: is not an object; expected names and values");
  EXPECT_EQ(diagnostic(std::string(fewer_if_sanitized<std::size_t>(5'000'000, 10), '[')),
            "line 1: is damaged or not JSON; expected an NV image");
  EXPECT_EQ(diagnostic(with_registers("{\"a\": " + std::string(1'000'000, '9') + "}")),
            "a number is too large; expected one that fits in 64 bits");
  const std::string long_name(2'000'000, 'n');
  EXPECT_EQ(parse_nv_image(with_registers("{\"" + long_name + "\": 1}")).registers.front().first, long_name);
  std::string many = "{";
  for (int i = 0; i < 100'000; ++i)
    many += (i == 0 ? "\"r" : ",\"r") + std::to_string(i) + "\":" + std::to_string(i);
  EXPECT_EQ(parse_nv_image(with_registers(many + "}")).registers.size(), 100'000u);
}

// --- the image of a device ---------------------------------------------------------------------------------

std::unique_ptr<Device> device(const std::optional<NvImage>& nv = {}, Firmware firmware = 0) {
  DeviceSettings settings;
  settings.name = "feeder";
  settings.firmware = firmware;
  settings.nv = nv;
  return make_device(models::simple2_r3::model(), settings);
}

std::string device_diagnostic(NvImage image) {
  try {
    device(image);
    return "";
  } catch (const NvError& error) {
    return error.what();
  }
}

TEST(NvImageOfADevice, FromTheFactoryIsEmpty) {
  EXPECT_EQ(device()->memory()->nv_image(),
            (NvImage{.model = "simple2-r3", .firmware = "1.52", .registers = {}}));
  EXPECT_EQ(device({}, 139)->memory()->nv_image().firmware, "1.39");
}

TEST(NvImageOfADevice, BringsEveryRegisterBack) {
  EXPECT_EQ(device(kExample)->memory()->nv_image(), kExample) << "also in the order of the table";
  NvImage shuffled = kExample;
  std::mt19937_64 random(5);
  std::shuffle(shuffled.registers.begin(), shuffled.registers.end(), random);
  EXPECT_EQ(device(shuffled)->memory()->nv_image(), kExample);
}

TEST(NvImageOfADevice, LeavesOutWhatIsAsFromTheFactory) {
  NvImage image = kExample;
  image.registers.emplace_back("Aaxis_Resoultion", 3200);
  EXPECT_EQ(device(image)->memory()->nv_image(), kExample);
}

TEST(NvImageOfADevice, OutlivesAFirmwareUpdateAndItsUndoing) {
  const NvImage locked{.model = "simple2-r3", .firmware = "1.52", .registers = {{"NEW_PWD", 77}}};
  NvImage old = device(locked, 139)->memory()->nv_image();
  EXPECT_EQ(old.registers, locked.registers);
  EXPECT_EQ(old.firmware, "1.39");
  EXPECT_EQ(device(old)->memory()->nv_image(), locked);
}

TEST(NvImageOfADevice, IsRefusedWhereItSuitsAnotherOne) {
  const auto with = [](const char* name, std::int64_t value) {
    return NvImage{.model = "simple2-r3", .firmware = "1.52", .registers = {{name, value}}};
  };
  struct Case {
    NvImage image;
    const char* diagnostic;  // part of it
  };
  const Case cases[] = {
      {{.model = "rsm8194h", .firmware = "1.00", .registers = {}},
       "model: is the memory of a 'rsm8194h'; expected one of simple2-r3"},
      {with("PROG_MEM32", 1), "no register is called 'PROG_MEM32'"},
      {with("", 1), "registers: "},
      {with("Cord_A", 1), "'Cord_A' is not persistent"},
      {with("PROG_VAR0", 1), "'PROG_VAR0' is not persistent"},
      {with("PROG_MEM0_RegL", 1), "registers: "},  // half a register
      {with("Parms_Speed1.3", 1), "registers: "},  // a bit of one
      {with("Parms_Speed1", 65'536), "'Parms_Speed1': 65536 does not fit"},
      {with("Parms_Speed1", -1), "'Parms_Speed1': -1 does not fit"},
      {with("PROG_MEM0", 2'147'483'648), "'PROG_MEM0': 2147483648 does not fit"},
      {with("PROG_MEM0", INT64_MIN), "does not fit"},
      {with("ENCA_Resoultion", -1), "'ENCA_Resoultion': -1 does not fit"},
      {with("MAIN_LINE0_CMD", 256), "'MAIN_LINE0_CMD': 256 does not fit"},
  };
  for (const Case& c : cases) {
    const std::string found = device_diagnostic(c.image);
    EXPECT_TRUE(is_one_line(found)) << c.diagnostic << ": " << found;
    EXPECT_NE(found.find(c.diagnostic), std::string::npos) << c.diagnostic << ": " << found;
  }
}

}  // namespace nv_image_test
}  // namespace understudy::emulator
