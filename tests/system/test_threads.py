"""Several threads: whoever takes them gets them, and the bits are those of one."""
import pathlib
import unittest

from runs import LONG, Run, datasets, ended

# Two blocks of grains, all of them awake from the start: the tail is faster than the head.
BLOCKS = ("--set", "impactor.slug.particle.diameter=1.5 mm", "--set", "impactor.slug.tail_speed=120 m/s",
          "--set", "time.end=0.02", "--set", "impactor.engine=native")


class Threads(unittest.TestCase):
    def threads_of(self, side, *options):
        """How many a side has in mid-run."""
        with Run(*LONG, *options) as run:
            run.wait_for_rows()
            return len(list(pathlib.Path(f"/proc/{run.process_of(side)}/task").iterdir()))

    def test_both_sides_give_the_bits_of_one_thread(self):
        """Six for both: whichever is slower has more than one, and the other one, too, where it takes as long."""
        one, six = ended(self, *BLOCKS, "--threads", "1"), ended(self, *BLOCKS, "--threads", "6")
        self.assertEqual(one.summary()["threads"], {"impactor": 1, "structure": 1})
        self.assertEqual(sum(six.summary()["threads"].values()), 6)
        self.assertEqual(*(datasets(run.out / "results.h5") for run in (one, six)))

    def test_the_side_that_takes_them_has_them(self):
        """LAMMPS has ranks instead."""
        alone = self.threads_of("structure", "--threads", "1")
        self.assertEqual(self.threads_of("structure", "--threads", "4"), alone + 2)

    def test_no_thread_at_all_is_refused(self):
        run = Run("--threads", "0")
        self.addCleanup(run.__exit__)
        run.end()
        self.assertEqual(run.code, 2)
        self.assertIn("--threads", run.stderr)


if __name__ == "__main__":
    unittest.main()
