"""The books of the interface, against sums by hand."""

import unittest

import numpy
from support import wire  # noqa: F401  puts the package on the path

from grainstep.books import Books


class HalfSteps(unittest.TestCase):
    def test_nothing_has_passed_at_the_start(self):
        books = Books(2)
        books.open(numpy.array([[0.0, 3.0]]), numpy.array([[0.0, 2.0]]), 0.0)
        self.assertEqual(list(books.at().impulse), [0.0, 0.0])
        self.assertEqual(books.at().work, 0.0)

    def test_half_of_a_step_lies_before(self):
        books = Books(2)
        impulse, before, after = numpy.array([[1.0, 3.0], [0.0, 1.0]]), numpy.full((2, 2), 2.0), numpy.full((2, 2), 4.0)
        books.open(impulse, before, 0.0)
        books.close(after)
        books.open(impulse, after, 0.5)
        at = books.at()
        self.assertEqual(list(at.impulse), [1.5, 6.0])
        # 5 N s over (2 + 4)/2 m/s in the first step, half of 5 N s at 4 m/s in the second.
        self.assertEqual(at.work, 5.0 * 3.0 + 0.5 * 5.0 * 4.0)

    def test_three_dimensions(self):
        books = Books(3)
        books.open(numpy.ones((4, 3)), numpy.zeros((4, 3)), 0.0)
        books.close(numpy.ones((4, 3)))
        books.open(numpy.zeros((4, 3)), numpy.ones((4, 3)), 0.5)
        self.assertEqual(list(books.at().impulse), [4.0, 4.0, 4.0])
        self.assertEqual(books.at().work, 6.0)

    def test_work_is_what_kinetic_energy_gains(self):
        """A free mass: (1/2) m V(n-1/2) V(n+1/2) is the work up to t(n), exactly, whatever the impulses."""
        books, mass, velocity = Books(2), 0.5, numpy.zeros((1, 2))
        for impulse, part in ((2.0, 0.0), (1.0, 0.5), (-4.0, 0.5), (0.25, 0.5)):
            push = numpy.array([[0.0, impulse]])
            after = velocity + push / mass
            books.open(push, velocity, part)
            kinetic = 0.5 * mass * velocity[0, 1] * (after if part else velocity)[0, 1]
            self.assertAlmostEqual(books.at().work, kinetic, delta=1e-13)
            books.close(after)
            velocity = after


if __name__ == "__main__":
    unittest.main()
