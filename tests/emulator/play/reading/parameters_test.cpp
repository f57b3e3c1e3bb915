// ${...}: its value, and its errors.
#include "emulator/play/reading/parameters.h"

#include <gtest/gtest.h>

#include "emulator/world/expression/tokens.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::play {
namespace parameters_test {

class ParametersTest : public testing::Test {
 protected:
  ParametersTest() {
    parameters_.define("speed", "200");
    parameters_.define("takes", "3050ms");
    parameters_.define("volts", "2.5V");
    parameters_.define("word", "feeder");
    parameters_.define("sum", "3 * 4");
    parameters_.define("hex", "0x10");
  }
  std::string diagnostic(const std::string& text) const {
    try {
      return "made " + parameters_.apply(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }
  Parameters parameters_;
};

TEST_F(ParametersTest, AreReplacedAndComputedWith) {
  const std::pair<const char*, const char*> rows[] = {
      {"", ""},
      {"plain", "plain"},
      {"$", "$"},
      {"$5 {x}", "$5 {x}"},
      {"${speed}", "200"},
      {"${ speed }", "200"},
      {"${word}", "feeder"},
      {"${hex}", "0x10"},    // as written,
      {"${hex + 0}", "16"},  // until it is used in a calculation
      {"${word}.Cord_A", "feeder.Cord_A"},
      {"a ${speed} b ${takes} c", "a 200 b 3050ms c"},
      {"${speed * 2}", "400"},
      {"${speed / 3}", "66"},  // whole quotients are truncated
      {"${speed / 3.0 > 66}", "1"},
      {"${takes + 5ms}", "3.055s"},
      {"${takes / 1ms}", "3050"},
      {"${2 * volts}", "5V"},
      {"${sum + 1}", "13"},
      {"${speed > 100 ? 7 : 8}", "7"},
      {"${max(speed, 300)}", "300"},
      {"$${speed}", "${speed}"},
      {"$${a} ${speed}", "${a} 200"},
  };
  for (const auto& [written, made] : rows) EXPECT_EQ(parameters_.apply(written), made) << written;
}

TEST_F(ParametersTest, AValueIsComputedBeforeItIsUsed) {
  parameters_.define("difference", "3 - 1");
  EXPECT_EQ(parameters_.apply("${10 - difference}"), "8");  // not 10 - 3 - 1
}

TEST_F(ParametersTest, ComplainOfWhatTheyAreNot) {
  const std::pair<const char*, const char*> rows[] = {
      {"${sped}", "column 1 of 'sped': no parameter is called 'sped'; the nearest is 'speed'"},
      {"${speed", "'${' is not closed; expected '}' after it"},
      {"${}", "column 1 of '': unexpected end; expected a name, a number or '('"},
      {"${speed + }", "column 9 of 'speed + ': unexpected end; expected a name, a number or '('"},
      {"${word + 1}",
       "column 1 of 'word + 1': parameter 'word' is 'feeder', which expressions cannot use; expected a "
       "number, a duration or a voltage"},
      {"${speed / 0}", "column 7 of 'speed / 0': division by zero  (speed is 200)"},
  };
  for (const auto& [written, message] : rows) EXPECT_EQ(diagnostic(written), message) << written;
  EXPECT_NE(diagnostic("${speed + takes}").find("duration"), std::string::npos)
      << diagnostic("${speed + takes}");
  EXPECT_EQ(Parameters().names(), std::vector<std::string>());
}

TEST_F(ParametersTest, HaveNamesOfTheirOwn) {
  for (const char* name : {"", "1a", "a b", "a.b", "and", "true", "a-b", "${x}", "[\"a\"]"}) {
    EXPECT_THROW(parameters_.define(name, "1"), world::NameError) << name;
  }
  EXPECT_THROW(parameters_.define("speed", "1"), world::NameError);
  Parameters inner(parameters_);
  EXPECT_THROW(inner.define("speed", "1"), world::NameError);  // a loop hides nothing
  inner.define("i", "3");
  EXPECT_EQ(inner.apply("${speed + i}"), "203");
  EXPECT_EQ(parameters_.find("i"), nullptr);
}

TEST_F(ParametersTest, RememberWhichWereUsed) {
  const Parameters inner(parameters_);
  inner.apply("${speed * 2} $${takes}");
  EXPECT_TRUE(parameters_.was_used("speed"));
  EXPECT_FALSE(parameters_.was_used("takes"));
}

TEST_F(ParametersTest, DoNotGrowWithoutEnd) {
  Parameters inner(parameters_);
  std::string name = "a";
  inner.define(name, std::string(1000, 'x'));
  std::string many;
  for (int i = 0; i < 2000; ++i) many += "${a}";
  EXPECT_THROW(inner.apply(many), world::NameError);
}

}  // namespace parameters_test
}  // namespace understudy::emulator::play
