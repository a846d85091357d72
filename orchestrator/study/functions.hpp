/// @file The functions that expressions know.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orchestrator/study/expression.hpp"

namespace grainstep::study {

struct Function {
  std::string name;
  std::string signature;  ///< for people
  std::size_t arguments;
  Values (*apply)(const std::vector<Values>& arguments);
};

[[nodiscard]] const std::vector<Function>& functions();
[[nodiscard]] const Function* find_function(const std::string& name);

/// Item by item; a list of one goes with any length. @throws InputError for other lengths.
[[nodiscard]] Values combine(const Values& left, const Values& right, double (*operation)(double, double));

}  // namespace grainstep::study
