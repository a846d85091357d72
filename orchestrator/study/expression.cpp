#include "orchestrator/study/expression.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "declare/suggest.hpp"
#include "orchestrator/study/functions.hpp"

namespace grainstep::study {

struct Expression::Node {
  enum class Kind { number, name, operation, function, elsewhere };
  Kind kind = Kind::number;
  double number = 0.0;
  std::string name;  ///< of a name; where to look
  double (*operation)(double, double) = nullptr;
  const Function* function = nullptr;
  std::vector<std::unique_ptr<Node>> parts;
};

namespace {

using Node = Expression::Node;
using Part = std::unique_ptr<Node>;

constexpr int deepest = 100;

double add(double a, double b) { return a + b; }
double subtract(double a, double b) { return a - b; }
double multiply(double a, double b) { return a * b; }
double divide(double a, double b) { return a / b; }
double power(double a, double b) { return std::pow(a, b); }

Part number(double value) {
  auto node = std::make_unique<Node>();
  node->number = value;
  return node;
}

Part operation(double (*what)(double, double), Part left, Part right) {
  auto node = std::make_unique<Node>();
  node->kind = Node::Kind::operation;
  node->operation = what;
  node->parts.push_back(std::move(left));
  node->parts.push_back(std::move(right));
  return node;
}

/// sum = product {(+|-) product}; product = signed {(*|/) signed}; signed = [-] power; power = atom [^ signed].
class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  Part parse() {
    Part whole = sum();
    if (at_ < text_.size()) fail("expected an operator");
    return whole;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const std::string found = at_ < text_.size() ? "found '" + text_.substr(at_, 1) + "'" : "it ends there";
    throw InputError("'" + text_ + "': " + what + " at character " + std::to_string(at_ + 1) + ", " + found);
  }

  void skip_spaces() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  bool take(char c) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    skip_spaces();
    return true;
  }

  void require(char c) {
    if (!take(c)) fail(std::string("expected '") + c + "'");
  }

  Part sum() {
    if (++depth_ > deepest) fail("nested too deeply");
    Part left = product();
    while (true) {
      if (take('+')) {
        left = operation(add, std::move(left), product());
      } else if (take('-')) {
        left = operation(subtract, std::move(left), product());
      } else {
        --depth_;
        return left;
      }
    }
  }

  Part product() {
    Part left = with_sign();
    while (true) {
      if (take('*')) {
        left = operation(multiply, std::move(left), with_sign());
      } else if (take('/')) {
        left = operation(divide, std::move(left), with_sign());
      } else {
        return left;
      }
    }
  }

  Part with_sign() {
    if (++depth_ > deepest) fail("nested too deeply");
    Part out = take('-') ? operation(subtract, number(0.0), with_sign()) : powers();
    --depth_;
    return out;
  }

  Part powers() {
    Part base = atom();
    return take('^') ? operation(power, std::move(base), with_sign()) : std::move(base);
  }

  Part atom() {
    skip_spaces();
    if (take('(')) {
      Part inner = sum();
      require(')');
      return inner;
    }
    if (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0) return name();
    double value = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc()) fail("expected a number, a name or '('");
    at_ = static_cast<std::size_t>(end - text_.data());
    skip_spaces();
    return number(value);
  }

  Part name() {
    const std::size_t begin = at_;
    const auto part_of_name = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
    };
    while (at_ < text_.size() && part_of_name(text_[at_])) ++at_;
    auto node = std::make_unique<Node>();
    node->kind = Node::Kind::name;
    node->name = text_.substr(begin, at_ - begin);
    if (!take('(')) return node;
    return node->name == "in" ? elsewhere(std::move(node)) : call(std::move(node));
  }

  /// in(WHERE, expression): the place is any text up to the comma, or in quotes.
  Part elsewhere(Part node) {
    node->kind = Node::Kind::elsewhere;
    const bool quoted = at_ < text_.size() && text_[at_] == '\'';
    if (quoted) ++at_;
    const std::size_t end = text_.find(quoted ? '\'' : ',', at_);
    if (end == std::string::npos) fail("expected in(WHERE, EXPRESSION) or in('WHERE', EXPRESSION)");
    node->name = text_.substr(at_, end - at_);
    if (!quoted) node->name.erase(node->name.find_last_not_of(' ') + 1);
    at_ = quoted ? end + 1 : end;
    require(',');
    node->parts.push_back(sum());
    require(')');
    return node;
  }

  Part call(Part node) {
    node->kind = Node::Kind::function;
    node->function = find_function(node->name);
    if (node->function == nullptr) {
      std::vector<std::string> known = {"in"};
      for (const Function& f : functions()) known.push_back(f.name);
      throw InputError("'" + text_ + "': unknown function '" + node->name + "'" + declare::hint(node->name, known) +
                       " Known: " + declare::join_words(known));
    }
    do {
      node->parts.push_back(sum());
    } while (take(','));
    require(')');
    if (node->parts.size() != node->function->arguments) fail("expected " + node->function->signature);
    return node;
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Values evaluate_node(const Node& node, const Names& names) {
  switch (node.kind) {
    case Node::Kind::number:
      return {node.number};
    case Node::Kind::name:
      return names.value(node.name);
    case Node::Kind::operation:
      return combine(evaluate_node(*node.parts[0], names), evaluate_node(*node.parts[1], names), node.operation);
    case Node::Kind::function: {
      std::vector<Values> arguments;
      for (const Part& part : node.parts) arguments.push_back(evaluate_node(*part, names));
      return node.function->apply(arguments);
    }
    case Node::Kind::elsewhere:
      break;
  }
  const Names* there = names.elsewhere(node.name);
  return there == nullptr ? Values{std::numeric_limits<double>::quiet_NaN()} : evaluate_node(*node.parts[0], *there);
}

void visit_node(const Node& node, const std::string& where,
                const std::function<void(const std::string&, const std::string&)>& name) {
  if (node.kind == Node::Kind::name) name(node.name, where);
  for (const Part& part : node.parts) visit_node(*part, node.kind == Node::Kind::elsewhere ? node.name : where, name);
}

}  // namespace

Expression::Expression(const std::string& text) : text_(text), root_(Parser(text_).parse()) {}
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::~Expression() = default;

Values Expression::evaluate(const Names& names) const {
  try {
    return evaluate_node(*root_, names);
  } catch (const InputError& error) {
    throw InputError("'" + text_ + "': " + error.what());
  }
}

double Expression::number(const Names& names) const {
  const Values values = evaluate(names);
  if (values.size() != 1) {
    throw InputError("'" + text_ + "' is a list of " + std::to_string(values.size()) +
                     " values, one number was expected; min, max, mean, last, interpolate, ... make one of it");
  }
  return values[0];
}

void Expression::visit(const std::function<void(const std::string&, const std::string&)>& name) const {
  visit_node(*root_, "", name);
}

}  // namespace grainstep::study
