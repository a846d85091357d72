#include "support/verification_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace grainstep::verification {
namespace {

using nlohmann::json;

void expect_group(const std::string& group) {
  constexpr std::array known{"particles", "contact", "structure", "coupled", "hard cases", "convergence"};
  if (std::find(known.begin(), known.end(), group) == known.end()) {
    throw std::invalid_argument("verification: unknown group '" + group + "'");
  }
}

/// Name of the running test as CTest knows it.
std::string test_name() {
  if (const char* name = std::getenv("GRAINSTEP_TEST")) return name;
  const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
  return info == nullptr ? "unknown" : std::string(info->test_suite_name()) + "." + info->name();
}

std::string file_name(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '-'; }, '_');
  return text;
}

/// Where to write; empty where nobody asked for a record.
std::filesystem::path directory() {
  const char* asked = std::getenv("GRAINSTEP_VERIFICATION_DIR");
  if (asked == nullptr || *asked == '\0') return {};
  std::filesystem::create_directories(asked);
  return asked;
}

/// Tests run at the same time: a file for each.
void append(const std::filesystem::path& where, json line) {
  line["test"] = test_name();
  std::ofstream file(where / (file_name(test_name()) + ".jsonl"), std::ios::app);
  file << line.dump() << '\n';
  if (!file.flush()) ADD_FAILURE() << "cannot write to " << where;
}

}  // namespace

double allowed(const Comparison& c) { return c.expected == 0.0 ? c.tolerance : c.tolerance * std::abs(c.expected); }

void check(const Comparison& c) {
  expect_group(c.group);
  const double difference = c.found - c.expected;
  const bool passed = std::abs(difference) <= allowed(c);
  EXPECT_TRUE(passed) << c.group << ", " << c.name << ", " << c.quantity << ": found " << c.found << " " << c.unit
                      << ", expected " << c.expected << " (" << c.reference << "), difference " << difference
                      << ", allowed " << allowed(c) << " (" << c.reason << ")";
  const std::filesystem::path where = directory();
  if (where.empty()) return;
  append(where, {{"group", c.group},
                 {"name", c.name},
                 {"quantity", c.quantity},
                 {"unit", c.unit},
                 {"reference", c.reference},
                 {"origin", c.origin},
                 {"expected", c.expected},
                 {"found", c.found},
                 {"tolerance", c.tolerance},
                 {"reason", c.reason},
                 {"passed", passed}});
}

void curve(const Curve& c) {
  expect_group(c.group);
  const std::filesystem::path where = directory();
  if (where.empty()) return;
  const std::string csv = file_name(c.name + "-" + c.title) + ".csv";
  std::ofstream file(where / csv);
  file.precision(std::numeric_limits<double>::max_digits10);
  file << "series,x,y\n";
  json marks = json::array();
  for (std::size_t s = 0; s < c.series.size(); ++s) {
    const Series& series = c.series[s];
    if (series.x.size() != series.y.size()) throw std::invalid_argument("verification: uneven series " + series.label);
    for (std::size_t i = 0; i < series.x.size(); ++i) file << s << ',' << series.x[i] << ',' << series.y[i] << '\n';
    marks.push_back({{"label", series.label}, {"mark", series.mark == Series::Mark::line ? "line" : "points"}});
  }
  if (!file.flush()) ADD_FAILURE() << "cannot write to " << where;
  constexpr std::array axes{"linear", "log_log", "log_x", "log_y"};
  append(where, {{"group", c.group},
                 {"name", c.name},
                 {"curve", csv},
                 {"title", c.title},
                 {"x_label", c.x_label},
                 {"y_label", c.y_label},
                 {"axes", axes[static_cast<std::size_t>(c.axes)]},
                 {"series", marks}});
}

}  // namespace grainstep::verification
