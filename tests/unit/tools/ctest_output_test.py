"""Which tests failed, as CTest says it."""
import unittest

import ctest_output

SAID = """90% tests passed, 4 tests failed out of 40

Label Time Summary:
unit    =   5.09 sec*proc (84 tests)

The following tests did not run:
\t  3 - containers.compose (Skipped)
\t  4 - Old.Test (Disabled)

The following tests FAILED:
\t 17 - Ring.IsWoken (Failed)
\t 18 - Handshake/Wrong.IsRefused/no_nodes  # GetParam() = 48-byte object <DB-D8 22-33> (Failed)
\t 19 - Malformed.IsRefused/a: (x) (SEGFAULT)
\t 20 - Slow.One (Timeout)
Errors while running CTest
"""
NAMES = ["Ring.IsWoken", "Handshake/Wrong.IsRefused/no_nodes", "Malformed.IsRefused/a:"]


class Failed(unittest.TestCase):
    def test_whatever_a_name_holds(self):
        self.assertEqual(ctest_output.failed(SAID), NAMES + ["Slow.One"])

    def test_who_ran_out_of_time_may_be_left_out(self):
        self.assertEqual(ctest_output.failed(SAID, timeouts=False), NAMES)

    def test_nobody(self):
        self.assertEqual(ctest_output.failed("100% tests passed, 0 tests failed out of 40\n"), [])


if __name__ == "__main__":
    unittest.main()
