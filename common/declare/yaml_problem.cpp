#include "declare/yaml_problem.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "declare/problems.hpp"

namespace grainstep::declare {
namespace {

struct Explanation {
  int line = 0;
  std::string text;
};

std::string_view line_of(const std::string& text, std::size_t line) {
  std::string_view rest = text;
  for (std::size_t i = 0; i < line && !rest.empty(); ++i) {
    const auto end = rest.find('\n');
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  return rest.substr(0, rest.find('\n'));
}

bool is_indented_by_tab(std::string_view line) {
  const auto first = line.find_first_not_of(' ');
  return first != std::string_view::npos && line[first] == '\t';
}

/// The reader's complaints are about bytes.
Explanation about_bytes(const yaml_parser_t& parser, const std::string& text) {
  const std::size_t offset = std::min(parser.problem_offset, text.size());
  const auto before = text.begin() + static_cast<std::ptrdiff_t>(offset);
  const int line = static_cast<int>(1 + std::count(text.begin(), before, '\n'));
  if (std::string_view(parser.problem).find("control") == std::string_view::npos) {
    return {line, std::string("not UTF-8 (") + parser.problem + "); expected YAML text in UTF-8"};
  }
  return {line, "a control character (byte " + std::to_string(parser.problem_value) + "); expected YAML text in UTF-8"};
}

/// What libyaml was reading, and what it met.
struct Complaint {
  std::string_view context, problem;
};

/// Slips whose place is where the reading began.
std::string begun_wrongly(const Complaint& what) {
  if (what.context == "while scanning a quoted scalar" && what.problem == "found unexpected end of stream") {
    return "the quotation mark that opens a text here is never closed";
  }
  if (what.context == "while scanning a simple key") {
    return "expected 'key: value', with a blank behind the colon, or a list item '- value'";
  }
  return {};
}

/// Slips whose place is where the reading stopped. `begun`: the line in which it began.
std::string stopped_wrongly(const Complaint& what, const std::string& begun) {
  if (what.context == "while parsing a flow mapping") {
    return "a comma is missing here, or the } of the { in line " + begun;
  }
  if (what.context == "while parsing a flow sequence") {
    return "a comma is missing here, or the ] of the [ in line " + begun;
  }
  if (what.context == "while parsing a flow node") return "a value is missing here, before a comma or a bracket";
  if (what.context == "while parsing a block mapping" && what.problem == "did not find expected key") {
    return "this is no further 'key: value' of the map that begins in line " + begun +
           ": look at the indentation, and for a stray quotation mark or bracket";
  }
  if (what.problem == "mapping values are not allowed in this context") {
    return "a colon makes no key here: look at the indentation, or put a text that holds ': ' in quotation marks";
  }
  if (what.problem == "found character that cannot start any token") {
    return "one of % @ ` begins a text; put the text in quotation marks";
  }
  return {};
}

/// libyaml says what its grammar expected; most slips have a shape that can be named.
Explanation about_text(const yaml_parser_t& parser, const std::string& text) {
  const Complaint what{parser.context == nullptr ? "" : parser.context,
                       parser.problem == nullptr ? "it cannot be read" : parser.problem};
  const auto line = static_cast<int>(parser.problem_mark.line) + 1;
  const auto begin = static_cast<int>(parser.context_mark.line) + 1;
  const std::string begun = std::to_string(begin);
  if (is_indented_by_tab(line_of(text, parser.problem_mark.line))) {
    return {line, "a tab stands in front of it: YAML forbids tabs for indentation; use blanks"};
  }
  if (std::string named = begun_wrongly(what); !named.empty()) return {begin, std::move(named)};
  if (std::string named = stopped_wrongly(what, begun); !named.empty()) return {line, std::move(named)};
  if (what.context.empty()) return {line, std::string(what.problem)};
  return {line, std::string(what.problem) + " (" + std::string(what.context) +
                    (begin == line ? ")" : ", which begins in line " + begun + ")")};
}

}  // namespace

std::string yaml_problem(const yaml_parser_t& parser, const std::string& text, const std::string& source) {
  const bool bytes = parser.error == YAML_READER_ERROR;
  Explanation why = bytes ? about_bytes(parser, text) : about_text(parser, text);
  const auto ends = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  const int lines = text.empty() || text.back() == '\n' ? ends : ends + 1;
  why.line = std::clamp(why.line, 1, std::max(lines, 1));  // the end of the file is behind its last line
  return problem_line({source, why.line}, "", (bytes ? "" : "not YAML: ") + why.text);
}

}  // namespace grainstep::declare
