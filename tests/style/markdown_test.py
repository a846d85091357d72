"""The checks of Markdown themselves: what they let pass, and what they must see."""
import pathlib
import tempfile
import unittest

import markdown


class Markdown(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.top = pathlib.Path(scratch.name)

    def problems(self, check, text, name="page.md"):
        page = self.top / name
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(text)
        return markdown.problems(check, self.top)

    def test_links_that_lead_somewhere(self):
        (self.top / "docs").mkdir()
        (self.top / "docs/other.md").write_text("# A title, `code` and more\n\n## Twice\n\n## Twice\n")
        text = ("# Top\n[a](docs/other.md), [b](docs/other.md#a-title-code-and-more), [c](docs/other.md#twice-1),\n"
                "[d](#top), [e](docs), [f](https://example.org/none), `[no](link)`\n\n```\n[no](link either)\n```\n")
        self.assertEqual(self.problems(markdown.wrong_links, text), [])

    def test_links_that_do_not(self):
        text = "# Top\n\nsee [a\nb](none.md), ![c](c.png)\n[d](#toop) [e](/etc/hosts)\n"
        found = self.problems(markdown.wrong_links, text)
        self.assertEqual([line.split(": no")[0] for line in found], [
            "page.md:4: link to 'none.md'", "page.md:4: link to 'c.png'", "page.md:5: link to '#toop'",
            "page.md:5: link to '/etc/hosts'"])

    def test_a_heading_in_code_is_none(self):
        self.assertEqual(len(self.problems(markdown.wrong_links, "# Top\n\n```\n# shell\n```\n\n[a](#shell)\n")), 1)

    def test_long_lines(self):
        word = "word " * 30
        self.assertEqual(self.problems(markdown.long_lines, f"fine\n{word}\n    {word}\n"), [
            "page.md:2: 150 characters, at most 120 are allowed; break the line",
            "page.md:3: 154 characters, at most 120 are allowed; break the line"])
        self.assertEqual(self.problems(markdown.long_lines, "x" * 120 + "\n"), [])

    def test_lines_that_may_be_long(self):
        far = "https://example.org/" + "x" * 120
        self.assertEqual(self.problems(markdown.long_lines, f"| {'cell ' * 40} |\n- [a link]({far}).\n"), [])
        self.assertEqual(len(self.problems(markdown.long_lines, f"a sentence with [a link]({far})\n")), 1)
        written = f"# T\n\n<!-- Written by a program -->\n{'word ' * 30}\n"
        self.assertEqual(self.problems(markdown.long_lines, written), [])

    def test_builds_and_runs_are_not_looked_at(self):
        for folder in ("build", "build-sanitize", "runs", ".git"):
            self.assertEqual(self.problems(markdown.long_lines, "x" * 200, f"{folder}/page.md"), [])


if __name__ == "__main__":
    unittest.main()
