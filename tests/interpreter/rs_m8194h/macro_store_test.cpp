// Macros that a memory stores as texts.
#include "interpreter/rs_m8194h/macro_store.h"

#include <gtest/gtest.h>

#include <vector>

#include "interpreter/rs_m8194h/listing.h"

namespace understudy::interpreter::rs_m8194h {
namespace macro_store_test {

const MacroName kFirst{false, 1};
const MacroName kIsr{true, 1};
const SharedText kOne("MP 1\nRSM_MACRO_TIMER 1\nEND\n");
const SharedText kTwo("MP 1\nRSM_MACRO_TIMER 2\nEND\n");
const SharedText kInterrupt("ISR 1\nRSM_MACRO_EXIT_MACRO\nEND\n");

TEST(RsM8194hMacroStore, FollowsItsTexts) {
  MacroStore store;
  EXPECT_EQ(store.find(kFirst), nullptr);
  store.update(std::vector<MacroStore::Stored>{{kFirst, kOne}, {kIsr, kInterrupt}});
  const Macro* first = store.find(kFirst);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->lines[0].values[0], 1U);
  EXPECT_EQ(store.find(kIsr)->lines[0].verb(), Verb::exit_macro);
  const Command* lines = first->lines.data();
  store.update(std::vector<MacroStore::Stored>{{kFirst, SharedText(kOne.text())}});
  EXPECT_EQ(store.find(kFirst)->lines.data(), lines);  // not read again
  EXPECT_EQ(store.find(kIsr), nullptr);
  store.update(std::vector<MacroStore::Stored>{{kFirst, kTwo}});
  EXPECT_EQ(store.find(kFirst)->lines[0].values[0], 2U);
  store.update({});
  EXPECT_EQ(store.find(kFirst), nullptr);
}

TEST(RsM8194hMacroStore, HoldsOnlyWhatIsTheMacrosListing) {
  EXPECT_TRUE(macro_of(kFirst, kOne.text()));
  EXPECT_FALSE(macro_of({false, 2}, kOne.text()));
  EXPECT_FALSE(macro_of(kIsr, kOne.text()));
  EXPECT_FALSE(macro_of(kFirst, kOne.text() + kInterrupt.text()));
  EXPECT_FALSE(macro_of(kFirst, kOne.text() + "TRIGGER 8.0 on pause"));
  EXPECT_FALSE(macro_of(kFirst, "MP 1\nRSM_MACRO_NEXT\nEND\n"));
  MacroStore store;
  store.update(std::vector<MacroStore::Stored>{{{false, 2}, kOne}, {{false, 158}, kOne}, {{true, 0}, kOne}});
  EXPECT_EQ(store.find({false, 2}), nullptr);
  EXPECT_EQ(store.find({false, 158}), nullptr);
  EXPECT_EQ(store.find({true, 0}), nullptr);
}

}  // namespace macro_store_test
}  // namespace understudy::interpreter::rs_m8194h
