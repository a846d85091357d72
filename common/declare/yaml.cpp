#include "declare/yaml.hpp"

#include <yaml.h>

#include <new>

#include "base/error.hpp"
#include "declare/tree_builder.hpp"
#include "declare/yaml_problem.hpp"

namespace grainstep::declare {
namespace {

/// libyaml's parser over one text.
class Parser {
 public:
  Parser(const std::string& text, const std::string& source) : text_(text), source_(source) {
    if (yaml_parser_initialize(&parser_) == 0) throw std::bad_alloc();
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;
  ~Parser() {
    yaml_event_delete(&event_);
    yaml_parser_delete(&parser_);
  }

  /// Valid until the next call.
  const yaml_event_t& next() {
    yaml_event_delete(&event_);
    if (yaml_parser_parse(&parser_, &event_) == 0) throw InputError(yaml_problem(parser_, text_, source_));
    return event_;
  }

 private:
  const std::string& text_;
  const std::string& source_;
  yaml_parser_t parser_{};
  yaml_event_t event_{};
};

std::string text_of(const yaml_char_t* text) {
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text));
}

int line_of(const yaml_event_t& event) { return static_cast<int>(event.start_mark.line) + 1; }

class Reading {
 public:
  Reading(std::string source, Problems& problems) : source_(std::move(source)), builder_(source_, problems) {}

  [[nodiscard]] Tree take() { return builder_.take(); }

  void read(const yaml_event_t& event) {
    const auto& data = event.data;
    switch (event.type) {
      case YAML_SCALAR_EVENT:
        refuse_tag(event, data.scalar.tag);
        return scalar(event);
      case YAML_ALIAS_EVENT:
        return builder_.alias({line_of(event), text_of(data.alias.anchor)});
      case YAML_SEQUENCE_START_EVENT:
        refuse_tag(event, data.sequence_start.tag);
        return builder_.open({line_of(event), text_of(data.sequence_start.anchor)}, Tree::Kind::list);
      case YAML_MAPPING_START_EVENT:
        refuse_tag(event, data.mapping_start.tag);
        return builder_.open({line_of(event), text_of(data.mapping_start.anchor)}, Tree::Kind::map);
      case YAML_SEQUENCE_END_EVENT:
      case YAML_MAPPING_END_EVENT:
        return builder_.close();
      case YAML_DOCUMENT_START_EVENT:
        if (++documents_ > 1) fail(event, "more than one YAML document (---); expected one");
        return;
      default:
        return;
    }
  }

 private:
  [[noreturn]] void fail(const yaml_event_t& event, const std::string& text) const {
    throw InputError(problem_line({source_, line_of(event)}, "", text));
  }

  void refuse_tag(const yaml_event_t& event, const yaml_char_t* tag) const {
    if (tag == nullptr) return;
    const std::string common = "tag:yaml.org,2002:";
    std::string name = text_of(tag);
    if (name.starts_with(common)) name.replace(0, common.size(), "!!");
    fail(event, "the tag " + name + ": nobody would read it; leave out what begins with an exclamation mark");
  }

  void scalar(const yaml_event_t& event) {
    const auto& found = event.data.scalar;
    const bool quoted = found.style != YAML_PLAIN_SCALAR_STYLE;
    const bool in_marks =
        found.style == YAML_SINGLE_QUOTED_SCALAR_STYLE || found.style == YAML_DOUBLE_QUOTED_SCALAR_STYLE;
    // A forgotten closing mark reaches as far as the next one, in a comment as well, and swallows the keys between.
    if (in_marks && event.start_mark.line != event.end_mark.line) {
      fail(event, "a text in quotation marks that begins here ends in line " + std::to_string(event.end_mark.line + 1) +
                      "; if its closing mark is missing here, add it, else write a text of several lines with | or >");
    }
    builder_.scalar({line_of(event), text_of(found.anchor)},
                    std::string(reinterpret_cast<const char*>(found.value), found.length), quoted);
  }

  std::string source_;
  TreeBuilder builder_;
  int documents_ = 0;
};

void check_size(const std::string& text, const std::string& source) {
  if (text.size() <= largest_file) return;
  throw InputError(source + ": " + std::to_string(text.size()) + " bytes; a scene has at most " +
                   std::to_string(largest_file));
}

}  // namespace

Tree parse_yaml(const std::string& text, const std::string& source, Problems& problems) {
  check_size(text, source);
  Parser parser(text, source);
  if (parser.next().data.stream_start.encoding != YAML_UTF8_ENCODING) {
    throw InputError(source + ": in UTF-16; expected YAML text in UTF-8");
  }
  Reading reading(source, problems);
  for (const yaml_event_t* event = &parser.next(); event->type != YAML_STREAM_END_EVENT; event = &parser.next()) {
    reading.read(*event);
  }
  Tree tree = reading.take();
  tree.origin = {source, 0};
  return tree;
}

}  // namespace grainstep::declare
