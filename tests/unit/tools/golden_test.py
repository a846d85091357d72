"""Golden runs: what is compared, what is refused. Runs are played; the golden.* tests read real ones."""
import importlib.machinery
import importlib.util
import pathlib
import tempfile
import unittest

import h5py

TOOL = pathlib.Path(__file__).resolve().parents[3] / "tools/golden"
loader = importlib.machinery.SourceFileLoader("golden", str(TOOL))
golden = importlib.util.module_from_spec(importlib.util.spec_from_loader("golden", loader))
loader.exec_module(golden)

HERE = "x86-64-v3, GCC 12"
OLD = {"ledger/energy": "aa", "series/time": "bb"}
NEW = {"ledger/energy": "cc", "series/time": "bb"}


def known(version=3, entries=OLD):
    return {"results_version": version, "forced": [],
            "machines": {HERE: {"beam": entries}, "another": {"beam": entries}}}


class Compare(unittest.TestCase):
    def test_equal_results_pass(self):
        self.assertEqual(golden.compare("beam", (HERE, OLD, 3), known())[0], 0)

    def test_a_change_under_the_same_version_names_the_dataset(self):
        code, text = golden.compare("beam", (HERE, NEW, 3), known())
        self.assertEqual(code, 1)
        self.assertIn("1 of 2 changed: ledger/energy", text)
        self.assertIn("results_version is still 3", text)

    def test_a_dataset_more_or_less_is_a_change(self):
        self.assertIn("1 of 3 new: more", golden.compare("beam", (HERE, {**OLD, "more": "dd"}, 3), known())[1])
        less = {"series/time": "bb"}
        self.assertIn("1 of 1 gone: ledger/energy", golden.compare("beam", (HERE, less, 3), known())[1])

    def test_a_new_version_wants_a_new_table(self):
        code, text = golden.compare("beam", (HERE, NEW, 4), known())
        self.assertEqual(code, 1)
        self.assertIn("tools/golden --update", text)

    def test_what_was_never_recorded_is_skipped_aloud(self):
        for machine, kind in (("x86-64-v4, GCC 12", "beam"), (HERE, "plate")):
            code, text = golden.compare(kind, (machine, OLD, 3), known())
            self.assertEqual(code, golden.SKIPPED)
            self.assertIn("skipped, nothing is recorded", text)


class Update(unittest.TestCase):
    def test_a_change_without_a_new_version_is_refused(self):
        with self.assertRaisesRegex(golden.Failed, "results_version was not raised"):
            golden.update({"beam": (HERE, NEW, 3)}, known(), None)

    def test_a_reason_is_kept_and_other_machines_are_not(self):
        new = golden.update({"beam": (HERE, NEW, 3)}, known(), "a unit was renamed")
        self.assertEqual(new["forced"], ["a unit was renamed"])
        self.assertEqual(new["machines"], {HERE: {"beam": NEW}})

    def test_a_new_version_forgets_what_others_recorded(self):
        new = golden.update({"beam": (HERE, NEW, 4)}, known(), None)
        self.assertEqual((new["results_version"], list(new["machines"])), (4, [HERE]))

    def test_what_is_written_is_read(self):
        self.assertEqual(golden.json.loads(golden.written(known())), known())

    def test_another_machine_is_added(self):
        new = golden.update({"beam": ("third", NEW, 3)}, known(), None)
        self.assertEqual(sorted(new["machines"]), ["another", "third", HERE])


class Hashes(unittest.TestCase):
    def hashes(self, energy, seconds):
        with tempfile.TemporaryDirectory() as scratch:
            path = pathlib.Path(scratch) / "results.h5"
            with h5py.File(path, "w") as file:
                file["build/isa"], file["build/compiler"] = "x86-64-v3", "GCC 12.2.0"
                file["ledger/energy"] = energy
                file["timings/time"] = seconds
                file["snapshots/structure/0001/position"] = [0.0]
                file["snapshots/structure/0001/point/velocity"] = [1.0]
            return golden.hashes_of(path)

    def test_times_are_left_out_and_a_snapshot_is_one_entry(self):
        machine, one = self.hashes([1.0, 2.0], [1.0])
        self.assertEqual(machine, HERE)
        self.assertEqual(sorted(one), ["ledger/energy", "snapshots/structure/0001"])
        self.assertEqual(self.hashes([1.0, 2.0], [7.0])[1], one)

    def test_the_last_bit_counts(self):
        _, one = self.hashes([1.0, 2.0], [1.0])
        _, other = self.hashes([1.0, 2.0 + 4.4e-16], [1.0])
        self.assertEqual(golden.differences(one, other), "1 of 2 changed: ledger/energy")


if __name__ == "__main__":
    unittest.main()
