#include "orchestrator/study/expression.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/error.hpp"

namespace grainstep::study {
namespace {

class Given : public Names {
 public:
  std::map<std::string, Values> values;
  std::map<std::string, const Names*> places;
  [[nodiscard]] Values value(const std::string& name) const override { return values.at(name); }
  [[nodiscard]] const Names* elsewhere(const std::string& where) const override {
    const auto found = places.find(where);
    return found == places.end() ? nullptr : found->second;
  }
};

double number(const std::string& text, const Given& given = {}) { return Expression(text).number(given); }

std::string error(const std::string& text, const Given& given = {}) {
  try {
    static_cast<void>(Expression(text).number(given));
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "accepted";
}

TEST(Expression, ArithmeticBindsAsOnPaper) {
  EXPECT_EQ(number("1 + 2*3 - 8/4/2"), 6);
  EXPECT_EQ(number("(1+2)*3"), 9);
  EXPECT_EQ(number("-2^2"), -4);
  EXPECT_EQ(number("2^-1"), 0.5);
  EXPECT_EQ(number("2^3^2"), 512);
  EXPECT_EQ(number("7 - 2 - 1"), 4);
  EXPECT_EQ(number("1.5e-3 * 2"), 3e-3);
  EXPECT_EQ(number("sqrt(abs(-16)) + log10(100) + exp(log(2))"), 8);
}

TEST(Expression, NamesAndListsItemByItem) {
  Given given;
  given.values = {{"a.b.0.c", {2}}, {"w", {1, 2, 4}}, {"t", {0, 1, 3}}};
  EXPECT_EQ(number("a.b.0.c / 4", given), 0.5);
  EXPECT_THAT(Expression("w * a.b.0.c - t").evaluate(given), ::testing::ElementsAre(2, 3, 5));
  EXPECT_EQ(number("max(w) - min(w) + first(w) + last(w) + count(w)", given), 11);
  EXPECT_DOUBLE_EQ(number("mean(w)", given), 7.0 / 3.0);
  EXPECT_DOUBLE_EQ(number("deviation(t)", given), std::sqrt(7.0 / 3.0));  // of a sample: n - 1
  EXPECT_EQ(number("interpolate(w, t, 2)", given), 3);
  EXPECT_EQ(number("interpolate(w, t, 0)", given), 1);
  EXPECT_TRUE(std::isnan(number("interpolate(w, t, 3.1)", given)));
  EXPECT_THAT(Expression("differences(w)").evaluate(given), ::testing::ElementsAre(1, 2));
  EXPECT_THAT(Expression("middles(w)").evaluate(given), ::testing::ElementsAre(1.5, 3));
  EXPECT_THAT(Expression("interpolate(w, t, grid(0, 3, 4))").evaluate(given), ::testing::ElementsAre(1, 2, 3, 4));
}

TEST(Expression, WhenALevelIsReached) {
  Given given;
  given.values = {{"t", {1, 2, 3, 4}}, {"y", {-1, 0, 4, 2}}};
  EXPECT_EQ(number("reached(y, t, 3)", given), 2.75);
  EXPECT_EQ(number("reached(y, t, -2)", given), 1);
  EXPECT_TRUE(std::isnan(number("reached(y, t, 4.1)", given)));
}

/// The mean rate over every interval of a grid, exactly, from a quantity that was summed up at other times.
TEST(Expression, RatesOverIntervalsOfAGrid) {
  Given given;
  given.values = {{"t", {0, 0.7, 1.1, 2}}, {"impulse", {0, 1.4, 2.2, 2.2}}};
  const Values rates = Expression("differences(interpolate(impulse, t, grid(0, 2, 3)))").evaluate(given);
  EXPECT_THAT(rates, ::testing::ElementsAre(::testing::DoubleEq(2.0), ::testing::DoubleNear(0.2, 1e-14)));
  EXPECT_THAT(Expression("grid(0.1, 0.3, 2)").evaluate(given), ::testing::ElementsAre(0.1, 0.3));
  EXPECT_THAT(error("max(grid(0, 1, 1))"), ::testing::HasSubstr("expected 2 to"));
}

TEST(Expression, OrderIsTheSlopeOfTheLogarithms) {
  Given given;
  given.values = {{"h", {1, 0.5, 0.25}}, {"e", {-3, -0.75, -0.1875}}};
  EXPECT_NEAR(number("order(e, h)", given), 2.0, 1e-14);
  EXPECT_NEAR(number("slope(2 + 3*h, h)", given), 3.0, 1e-14);
}

TEST(Expression, RowOfAnInterval) {
  Given given;
  given.values = {{"table", {1, 2, 3, 4, 5, 6}}, {"from", {0, 0.1, 0.2}}};
  EXPECT_THAT(Expression("row(table, from, 0.15)").evaluate(given), ::testing::ElementsAre(3, 4));
  EXPECT_THAT(Expression("row(table, from, 0)").evaluate(given), ::testing::ElementsAre(1, 2));
  EXPECT_THAT(Expression("row(table, from, -1)").evaluate(given), ::testing::IsEmpty());
}

TEST(Expression, IntegralOverTimeOfEveryColumn) {
  Given given;
  given.values = {{"table", {1, 2, 3, 4}}, {"from", {0, 1}}, {"to", {1, 3}}, {"x", {1, 2, 3}}};
  EXPECT_THAT(Expression("over_time(table, from, to)").evaluate(given), ::testing::ElementsAre(7, 10));
  EXPECT_THAT(error("max(over_time(x, from, to))", given), ::testing::HasSubstr("one row per interval"));
}

TEST(Expression, OtherPlacesAreNamedAsTheyAreWritten) {
  Given there;
  there.values = {{"w", {4}}};
  Given given;
  given.values = {{"w", {5}}};
  given.places = {{"mesh/D=2 mm, h_4", nullptr}, {"series one/x=2 m", &there}};
  EXPECT_EQ(number("w / in(series one/x=2 m, w) - 1", given), 0.25);
  given.places["D=2 mm, h/4"] = &there;
  EXPECT_EQ(number("in('D=2 mm, h/4', w) + in( series one/x=2 m , w)", given), 8);
  EXPECT_TRUE(std::isnan(number("w / in(not done, w)", given)));
  EXPECT_THAT(error("in(a b)"), ::testing::HasSubstr("expected in(WHERE, EXPRESSION)"));
}

TEST(Expression, NotANumberIsNotOverlooked) {
  Given given;
  given.values = {{"w", {1, std::nan(""), 2}}};
  EXPECT_TRUE(std::isnan(number("max(w)", given)));
  EXPECT_TRUE(std::isnan(number("mean(w)", given)));
}

TEST(Expression, SlipsAreNamed) {
  EXPECT_EQ(error("1 +"), "'1 +': expected a number, a name or '(' at character 4, it ends there");
  EXPECT_EQ(error("(1"), "'(1': expected ')' at character 3, it ends there");
  EXPECT_EQ(error("1 2"), "'1 2': expected an operator at character 3, found '2'");
  EXPECT_THAT(error("sqr(2)"), ::testing::HasSubstr("unknown function 'sqr'; did you mean 'sqrt'?"));
  EXPECT_THAT(error("order(1)"), ::testing::HasSubstr("expected order(y, x)"));
  EXPECT_THAT(error(std::string(500, '(')), ::testing::HasSubstr("nested too deeply"));
  EXPECT_THAT(error(std::string(500, '-')), ::testing::HasSubstr("nested too deeply"));
  Given given;
  given.values = {{"w", {1, 2}}, {"v", {1, 2, 3}}};
  EXPECT_THAT(error("w", given), ::testing::HasSubstr("is a list of 2 values, one number was expected"));
  EXPECT_THAT(error("w + v", given), ::testing::HasSubstr("lists of 2 and 3 values"));
}

}  // namespace
}  // namespace grainstep::study
