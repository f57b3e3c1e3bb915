// The command table compared with the manual's.
#include "interpreter/rs_m8194h/commands.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "tests/interpreter/rs_m8194h/printed.h"

namespace understudy::interpreter::rs_m8194h {
namespace commands_test {

TEST(RsM8194hCommands, AreThe229CodesOfTheManual) {
  const auto wanted = printed::facts("commands");
  ASSERT_EQ(wanted.size(), 229U);
  std::set<int> codes;
  for (const Fact& fact : wanted) {
    const std::uint16_t code = printed::code_of(fact);
    codes.insert(code);
    SCOPED_TRACE(fact.at("name"));
    const CommandRow* row = find_code(code);
    ASSERT_NE(row, nullptr);
    EXPECT_EQ(name_of(code), fact.at("name"));
    EXPECT_EQ(row->registers(), std::stoi(fact.at("registers")));
    EXPECT_EQ(row->section, fact.at("section"));
    EXPECT_EQ(row->cost, std::stoi(fact.at("cost")));
    EXPECT_EQ(row->use.starts_motion, fact.at("starts_motion") == "1");
    EXPECT_FALSE(row->meaning.empty());
    if (fact.at("real_time") == "1") {
      EXPECT_FALSE(is_macro_code(code));
      const std::map<std::string, RealTime> bypasses = {
          {"always", RealTime::immediate}, {"by_choice", RealTime::stop}, {"no", RealTime::queued}};
      EXPECT_EQ(row->use.real_time, bypasses.at(fact.at("bypass")));
      EXPECT_EQ(row->use.initial, fact.at("initial") == "1");
      EXPECT_EQ(row->use.refused_while_mp_runs, fact.at("while_mp_runs") == "refused");
      EXPECT_EQ(row->fifo_blocks(), std::stoi(fact.at("fifo_blocks")));
    } else {
      EXPECT_TRUE(is_macro_code(code));
      EXPECT_EQ(row->use.in_mp, fact.at("mp") == "1");
      EXPECT_EQ(row->use.in_isr, fact.at("isr") == "1");
      EXPECT_EQ(row->macro_lines(), std::stoi(fact.at("macro_lines")));
    }
  }
  for (int code = 0; code <= 0xFFFF; ++code) {
    EXPECT_EQ(find_code(static_cast<std::uint16_t>(code)) != nullptr, codes.contains(code)) << code;
  }
}

TEST(RsM8194hCommands, HaveTheParametersOfTheManual) {
  const auto allowed = printed::allowed();
  std::size_t count = 0;
  for (const CommandRow& row : kCommands) {
    SCOPED_TRACE(row.meaning);
    const auto found = allowed.find(static_cast<int>(row.verb));
    const std::size_t wanted = found == allowed.end() ? 0 : found->second.size();
    ASSERT_EQ(row.parameter_count(), wanted);
    for (std::size_t i = 0; i < wanted; ++i) {
      const printed::Allowed& one = found->second[i];
      const Parameter& parameter = row.parameters[i];
      EXPECT_EQ(parameter.name, one.name);
      EXPECT_EQ(parameter.registers(), one.registers);
      const std::map<std::string, Width> widths = {{"BYTE", Width::byte},
                                                   {"W", Width::byte},
                                                   {"U32", Width::unsigned_long},
                                                   {"I32", Width::signed_long},
                                                   {"F32", Width::real}};
      EXPECT_EQ(parameter.width, widths.at(one.type)) << one.name;
      if (!one.has_range()) continue;
      EXPECT_EQ(parameter.min, one.min) << one.name;
      EXPECT_EQ(parameter.max, one.max) << one.name;
      ++count;
    }
  }
  EXPECT_GT(count, 150U);
}

TEST(RsM8194hCommands, EachIsCarriedOutInOnePlace) {
  const auto wanted = printed::facts("commands");
  for (const CommandRow& row : kCommands) {
    const bool is_line = !row.macro_name.empty();
    const int in_macros = static_cast<int>(is_one_of(row.verb, kFlowVerbs)) +
                          static_cast<int>(is_one_of(row.verb, kReadVerbs)) +
                          static_cast<int>(is_one_of(row.verb, kDownloadVerbs));
    const bool is_devices = is_one_of(row.verb, kDeviceVerbs);
    EXPECT_LE(in_macros, 1) << row.meaning;
    EXPECT_TRUE(is_devices || in_macros == 1) << row.meaning;
    const bool has_real_time = !row.real_time_name.empty() && !is_one_of(row.verb, kDownloadVerbs);
    if (has_real_time) {
      EXPECT_TRUE(is_devices) << row.meaning;
    }
    if (is_line && in_macros == 1 && !has_real_time) {
      EXPECT_FALSE(is_devices) << row.meaning;
    }
  }
}

}  // namespace commands_test
}  // namespace understudy::interpreter::rs_m8194h
