#include "base/archive.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace grainstep::base {
namespace {

struct Point {
  double x = 0.0, y = 0.0;
  bool operator==(const Point&) const = default;
};

struct Inner {
  std::vector<Point> points;
  bool operator==(const Inner&) const = default;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("points", points);
  }
};

struct Outer {
  double number = 0.0;
  std::string text;
  std::vector<std::vector<int>> rows;
  std::vector<Inner> inner;
  std::array<Inner, 2> pair;
  std::optional<std::string> there, missing;
  bool operator==(const Outer&) const = default;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("number", number);
    archive("text", text);
    archive("rows", rows);
    archive("inner", inner);
    archive("pair", pair);
    archive("there", there);
    archive("missing", missing);
  }
};

Outer outer() {
  return {.number = 2.5,
          .text = std::string("a\0b", 3),
          .rows = {{1, 2}, {}, {3}},
          .inner = {{.points = {{1.0, 2.0}}}, {}},
          .pair = {Inner{{{5.0, 6.0}, {7.0, 8.0}}}, Inner{}},
          .there = "here",
          .missing = std::nullopt};
}

TEST(Archive, WhatIsSavedIsReadBack) {
  Outer from = outer();
  Outer into;
  into.missing = "something that was not saved";
  restore(into, saved(from));
  EXPECT_EQ(into, from);
}

std::string problem_of(const std::string& bytes) {
  Outer into;
  try {
    restore(into, bytes);
  } catch (const std::range_error& error) {
    return error.what();
  }
  return "";
}

TEST(Archive, WhatIsCutOffOrLeftOverIsToldWithItsPart) {
  Outer from = outer();
  const std::string bytes = saved(from);
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_NE(problem_of(bytes.substr(0, size)), "") << size;
  EXPECT_EQ(problem_of(bytes + "xy"), "2 bytes are left over");
  std::string renamed = bytes;
  renamed[bytes.find("rows")] = 'l';
  EXPECT_EQ(problem_of(renamed), "the part 'rows' is not where it is expected");
}

TEST(Archive, ACountThatIsNoneTakesNoMemory) {
  Outer from = outer();
  std::string bytes = saved(from);
  bytes.replace(bytes.find("text") + 4, 8, 8, '\x7f');
  EXPECT_EQ(problem_of(bytes), "the part 'text' is cut off");
}

struct Fixed {
  std::vector<std::vector<double>> rows;

  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed("rows", rows);
  }
};

TEST(Archive, SizesThatFollowFromTheModelMustBeTheSame) {
  Fixed from{{{1.0, 2.0}, {3.0}}};
  Fixed same{{{0.0, 0.0}, {0.0}}};
  restore(same, saved(from));
  EXPECT_EQ(same.rows, from.rows);
  Fixed fewer{{{0.0, 0.0}}};
  EXPECT_THROW(restore(fewer, saved(from)), std::range_error);
  Fixed longer{{{0.0, 0.0, 0.0}, {0.0}}};
  EXPECT_THROW(restore(longer, saved(from)), std::range_error);
}

}  // namespace
}  // namespace grainstep::base
