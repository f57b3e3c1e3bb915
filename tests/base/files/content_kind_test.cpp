// The kind of a file's contents by its first bytes, and which outputs may replace it.
#include "base/files/content_kind.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace understudy {
namespace content_kind_test {

using Kind = ContentKind;

struct Case {
  std::string head;
  Kind kind;
};

const std::string kDatabase("SQLite format 3\0\x10\0", 18);

const std::vector<Case> kCases = {
    {R"({"understudy":1,"kind":"recording","version":"0.2.0"})", Kind::recording},
    {"{\n  \"understudy\": 1,\n  \"kind\": \"snapshot\"", Kind::snapshot},
    {"{\n  \"understudy\": 1,\n  \"kind\": \"nv-image\",\n", Kind::nv_image},
    {R"({"firmware": "1.52", "kind": "nv-image", "understudy": 1})", Kind::nv_image},  // sorted by a tool
    {R"({"file":"grid.yaml","name":"move"})", Kind::results},
    {kDatabase, Kind::database},
    {"\x0a\x0d\x0d\x0a\x1c", Kind::capture},
    {"# simulated seconds, in (from the host) or out, line, bytes, # remark\n", Kind::capture},
    {"time_ms,A.pulses\n", Kind::trace},
    {"$version Understudy $end\n$timescale 1 ms $end\n", Kind::trace},
    {"<!DOCTYPE html>\n<html>", Kind::page},
    {"<!doctype html>", Kind::page},
    {"<?xml version=\"1.0\"?>\n<testsuites name=\"x\">", Kind::junit},
    {"<testsuite>", Kind::junit},
    {"\x89PNG\r\n\x1a\n", Kind::picture},
    {"<?xml version=\"1.0\"?>\n<svg width=\"1\">", Kind::picture},
    {"{\n \"understudy\": 1,\n \"kind\": \"photograph\",\n", Kind::photograph},
    {"{\n \"understudy\": 1,\n \"kind\": \"evidence\",\n", Kind::evidence},
    {"{\n \"understudy\": 1,\n \"kind\": \"certificate\",\n", Kind::certificate},
    {"# seconds since 1970, one or other (side of the line) or any, line, bytes\n", Kind::capture},
    {"understudy: 1\nlines:\n", Kind::bench},
    {"# a scenario\nunderstudy: 1\nbench: a.yaml\nsteps: []\n", Kind::scenario},
    {"understudy: 1\nname: x\nlines: {}\nsteps: []\n", Kind::scenario},
    {"understudy: 1\nsteps:\n  - advance: 1ms\n", Kind::steps},
    {"understudy: 1\nmodel: feeder\nregisters: list.csv\n", Kind::model},
    {"lines: {}\n", Kind::other},
    {"{\"kind\":\"something\"}", Kind::other},
    {"<?xml version=\"1.0\"?><note/>", Kind::other},
    {"precious\n", Kind::other},
};

TEST(ContentKind, IsRecognizedByHowAFileBegins) {
  for (const Case& c : kCases) EXPECT_EQ(name_of(content_of(c.head)), name_of(c.kind)) << c.head;
}

TEST(ContentKind, OfTheSameOrAnEmptyFileIsReplacedAlone) {
  for (const Case& there : kCases) {
    for (const Case& wanted : kCases) {
      const bool may = there.kind == wanted.kind;
      EXPECT_EQ(why_not_replaceable_by(wanted.kind, there.head).empty(), may)
          << there.head << " by " << name_of(wanted.kind);
    }
    EXPECT_EQ(why_not_replaceable_by(there.kind, ""), "");
  }
  EXPECT_EQ(why_not_replaceable_by(Kind::recording, "understudy: 1\nlines: {}\n"),
            "it is a bench; expected a recording to replace, or a free path");
  EXPECT_EQ(why_not_replaceable_by(Kind::nv_image, "precious"),
            "it is not an NV image; expected one to replace, or a free path");
}

TEST(ContentKind, OfWhatWasTornAtOnceIsThatOfItsWriter) {
  for (const auto& [kind, whole] : std::vector<std::pair<Kind, std::string>>{
           {Kind::recording, R"({"understudy":1,"kind":"recording")"},
           {Kind::snapshot, "{\n  \"understudy\": 1,\n  \"kind\": \"snapshot\""},
           {Kind::results, R"({"file":")"},
           {Kind::trace, "time_ms"},
           {Kind::database, kDatabase.substr(0, 16)}}) {
    for (std::size_t size = 0; size <= whole.size(); ++size) {
      EXPECT_TRUE(is_of_kind(kind, whole.substr(0, size))) << name_of(kind) << " of " << size << " bytes";
    }
  }
  EXPECT_FALSE(is_of_kind(Kind::recording, R"({"understudy":1,"kind":"nv)"));
  EXPECT_FALSE(is_of_kind(Kind::trace, "time,"));
}

TEST(ContentKind, OfAnotherFileIsCalledByItsName) {
  EXPECT_EQ(is_another_kind("understudy: 1\nbench: a.yaml\nsteps: []\n", Kind::recording),
            "is a scenario; expected a recording");
  EXPECT_EQ(is_another_kind("time_ms,x\n", Kind::program), "is a trace; expected a program");
  EXPECT_EQ(is_another_kind("LD M0\n", Kind::program), "");
  EXPECT_EQ(is_another_kind("time_ms,x\n", Kind::trace), "");
  EXPECT_EQ(the(Kind::nv_image) + ", " + the(Kind::recording), "the NV image, the recording");
}

}  // namespace content_kind_test
}  // namespace understudy
