/// @file What is no YAML, or YAML that says something else than its writer meant, is refused where it stands.
#include "declare/yaml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "base/error.hpp"

namespace grainstep::declare {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text) {
  Problems problems;
  try {
    static_cast<void>(parse_yaml(text, "x.yaml", problems));
    problems.throw_if_any();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

struct Refused {
  const char* text;
  const char* message;
};

// What is no ASCII is escaped: a byte that is no UTF-8 must not get into a test's name, which tools read as text.
void PrintTo(const Refused& one, std::ostream* out) {
  constexpr std::string_view digits = "0123456789abcdef";
  for (const unsigned char byte : std::string_view(one.text)) {
    if (byte >= 0x20 && byte < 0x7f) {
      *out << static_cast<char>(byte);
    } else {
      *out << "\\x" << digits[byte / 16] << digits[byte % 16];
    }
  }
}

class Malformed : public testing::TestWithParam<Refused> {};

TEST_P(Malformed, IsRefusedWhereItStands) { EXPECT_THAT(refusal(GetParam().text), HasSubstr(GetParam().message)); }

// Marked (*): yaml-cpp 0.7 takes it, most as another text than was meant.
INSTANTIATE_TEST_SUITE_P(
    Quotation, Malformed,
    testing::Values(Refused{"title: \"beam\nb: 2\n",
                            "x.yaml:1: not YAML: the quotation mark that opens a text"},                         // (*)
                    Refused{"a: 1\ntitle: 'beam\nb: 2\n", "x.yaml:2: not YAML: the quotation mark that opens"},  // (*)
                    Refused{"title: \"beam\nb: 2\n# a pipe of 5\"\nc: 3\n",
                            "x.yaml:1: a text in quotation marks that begins here ends in line 3"},  // (*)
                    Refused{"title: \"beam\nb: \"x\"\n", "x.yaml:1: a text in quotation marks"},
                    Refused{"a: \"x\" y\n", "x.yaml:1: not YAML: this is no further 'key: value'"},
                    Refused{"a: \"\\q\"\n", "unknown escape character"}, Refused{"a: \"\\xZZ\"\n", "not YAML"},
                    Refused{"a: \"\\ud800\"\n", "invalid Unicode character"}));

INSTANTIATE_TEST_SUITE_P(
    Brackets, Malformed,
    testing::Values(Refused{"a: 1\nb: { c: 1\n", "a comma is missing here, or the } of the { in line 2"},
                    Refused{"a: [1, 2\n", "a comma is missing here, or the ] of the [ in line 1"},
                    Refused{"a: [1, 2}\n", "the ] of the [ in line 1"}, Refused{"a: {b: 1]\n", "the } of the {"},
                    Refused{"a: {b: 1 c: 2}\n", "a comma is missing here"},
                    Refused{"a: [1, 2] 3\n", "look at the indentation, and for a stray quotation mark or bracket"},
                    Refused{"a: {b: 1} }\n", "a stray quotation mark or bracket"},
                    Refused{"a: [1,, 2]\n", "a value is missing here"},  // (*)
                    Refused{"a: {b: 1,, c: 2}\n", "a value is missing here"}));

INSTANTIATE_TEST_SUITE_P(
    Lines, Malformed,
    testing::Values(Refused{"a:\n\tb: 1\n", "x.yaml:2: not YAML: a tab stands in front of it: YAML forbids tabs"},
                    Refused{"a:\n  \tb: 1\n", "x.yaml:2: not YAML: a tab stands in front of it"},
                    Refused{"a:\n  b: 1\n\tc: 2\n", "x.yaml:3: not YAML: a tab stands in front of it"},
                    Refused{"a:\n    b: 1\n  c: 2\n",
                            "x.yaml:3: not YAML: this is no further 'key: value' of the map "
                            "that begins in line 1: look at the indentation"},
                    Refused{"a: 1\n  b: 2\n", "x.yaml:2: not YAML: a colon makes no key here"},
                    Refused{"a: b: c\n", "put a text that holds ': ' in quotation marks"},
                    Refused{"a: 1\n- b\n", "x.yaml:2: not YAML"}, Refused{"a: @x\n", "put the text in quotation marks"},
                    Refused{"a: 1\nb\n", "x.yaml:2: not YAML: expected 'key: value', with a blank behind the colon"}));

INSTANTIATE_TEST_SUITE_P(
    Names, Malformed,
    testing::Values(Refused{"a: &x 1\nb: &x 2\nc: *x\n",
                            "x.yaml:2: the anchor '&x' is already given in line 1"},  // (*)
                    Refused{"a: *x\n", "x.yaml:1: '*x' stands for nothing"},
                    Refused{"a: &x [*x]\n", "an alias inside of what it stands for"},
                    Refused{"a: &x &y 1\n", "not YAML"}, Refused{"a: &x 1\nb: &y *x\n", "not YAML"},
                    Refused{"a: !!int 1\n", "x.yaml:1: the tag !!int: nobody would read it"},   // (*)
                    Refused{"a: !include b.yaml\n", "the tag !include: nobody would read it"},  // (*)
                    Refused{"a: !e!x 1\n", "undefined tag handle"},                             // (*)
                    Refused{"a: 1\na: 2\n", "x.yaml:2: a: this key is already given in line 1"},
                    Refused{"? [a]\n: b\n", "a key must be a name, but here is a list"},
                    Refused{"~: b\n", "a key must be a name, but here is nothing"}));

INSTANTIATE_TEST_SUITE_P(Documents, Malformed,
                         testing::Values(Refused{"a: 1\n---\nb: 2\n", "x.yaml:2: more than one YAML document"},
                                         Refused{"a: 1\n...\nb: 2\n", "x.yaml:3: not YAML"},
                                         Refused{"%YAML 9.9\n---\na: 1\n", "incompatible YAML document"},
                                         Refused{"%FOO bar\n---\na: 1\n", "unknown directive name"},  // (*)
                                         Refused{"%YAML 1.1\na: 1\n", "not YAML"},                    // (*)
                                         Refused{"%a: 1\n", "not YAML"}));  // (*): as nothing at all

INSTANTIATE_TEST_SUITE_P(Bytes, Malformed,
                         testing::Values(Refused{"a: 1\nb: x\x01\n", "x.yaml:2: a control character (byte 1)"},
                                         Refused{"a: x\x7f\n", "x.yaml:1: a control character (byte 127)"},  // (*)
                                         Refused{"a: 1\nb: \"schr\xe4g\"\n", "x.yaml:2: not UTF-8"},  // (*): Latin-1
                                         Refused{"a: \xc0\xaf\n", "not UTF-8"}, Refused{"a: \xe2\x82", "not UTF-8"},
                                         Refused{"a: \xed\xa0\x80\n", "not UTF-8"},
                                         Refused{"a: 1\n\xef\xbb\xbf"
                                                 "b: 2\n",
                                                 "x.yaml:2: not YAML"}));  // (*)

TEST(Yaml, OtherEncodingsAreNamed) {
  EXPECT_EQ(refusal(std::string("\xff\xfe"
                                "a\0:\0 \0001\0",
                                10)),
            "x.yaml: in UTF-16; expected YAML text in UTF-8");
  EXPECT_EQ(refusal(std::string("\xfe\xff\0a\0:\0 \0001", 10)), "x.yaml: in UTF-16; expected YAML text in UTF-8");
  EXPECT_THAT(refusal(std::string("\xff\xfe\0\0a\0\0\0", 8)), HasSubstr("expected YAML text in UTF-8"));
}

TEST(Yaml, WhatIsWholeIsRead) {
  const std::string with_mark = std::string("\xef\xbb\xbf") + "a: 1\n";
  for (const char* const text :
       {"", "a: 1", "a: 1\r\nb: 2\r\n", with_mark.c_str(), "---\na: 1\n...\n", "%YAML 1.2\n---\na: 1\n",
        "a: &x [1, 2]\nb: *x\n", "a:\t1\n", "a: {\n\tb: 1 }\n", "a: |\n  two\n  lines\n", "a: 'it''s'\n", "a: b\"c\n",
        "a: >-\n  \"two\n  lines\"\n", "a: \"\\u00e4\"\n", "a: [1, 2,]\n"}) {
    EXPECT_EQ(refusal(text), "accepted") << text;
  }
}

TEST(Yaml, NothingIsWhatHasNoQuotationMarks) {
  Problems problems;
  const Tree tree = parse_yaml("a:\nb: ~\nc: null\nd: ''\ne: \"null\"\n", "x.yaml", problems);
  for (const auto* const name : {"a", "b", "c"}) EXPECT_EQ(tree.members.at(name).kind, Tree::Kind::null) << name;
  for (const auto* const name : {"d", "e"}) EXPECT_EQ(tree.members.at(name).kind, Tree::Kind::scalar) << name;
  EXPECT_EQ(tree.members.at("e").origin.line, 5);
}

}  // namespace
}  // namespace grainstep::declare
