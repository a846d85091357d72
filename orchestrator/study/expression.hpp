/// @file Small formulas over the numbers of runs: what a study file tabulates, plots and asserts (docs/user/studies.md
/// lists the functions). Every value is a list: one number for a run, many for a time history or for all runs of a
/// series. Arithmetic works item by item, a list of one goes with any length. A number that does not exist is NaN.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace grainstep::study {

using Values = std::vector<double>;

/// What names mean: for one run, or for all runs of a series.
class Names {
 public:
  virtual ~Names() = default;
  /// @throws InputError for a name that means nothing here.
  [[nodiscard]] virtual Values value(const std::string& name) const = 0;
  /// What `in(WHERE, ...)` looks at; nullptr: nothing of it is done, its values are NaN.
  [[nodiscard]] virtual const Names* elsewhere(const std::string& where) const = 0;
};

class Expression {
 public:
  /// @throws InputError: what was found, at which character.
  explicit Expression(const std::string& text);
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  /// @throws InputError for lists of different lengths and unknown names.
  [[nodiscard]] Values evaluate(const Names& names) const;
  /// A single number; @throws InputError if it is a list.
  [[nodiscard]] double number(const Names& names) const;

  /// Calls `name` for every name with the place it is looked for ("" outside of in()), so that slips are found before
  /// anything is run.
  void visit(const std::function<void(const std::string& name, const std::string& where)>& name) const;

  struct Node;

 private:
  std::string text_;
  std::unique_ptr<Node> root_;
};

}  // namespace grainstep::study
