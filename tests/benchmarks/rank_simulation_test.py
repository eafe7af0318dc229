#!/usr/bin/python3 -B
"""Ranks whose time is known in closed form."""
import dataclasses
import unittest

from rank_simulation import Costs, FileSystem, Simulation

NOTHING = Costs("", start=0.0, claim=0.0, reading=0.0, shapes=0, runs=[1.0], append=0.0, record=0, part=0.0, index=0.0,
                index_part=0.0)
FREE = FileSystem("", name=0.0, bandwidth=1.0, durable=0.0)


def with_costs(**changed):
    return dataclasses.replace(NOTHING, **changed)


class ManyRanks(unittest.TestCase):
    def test_without_costs_they_scale(self):
        for ranks in (1, 7, 100):
            self.assertAlmostEqual(Simulation(NOTHING, FREE, ranks, ranks, 10).time, 10.0)
            self.assertAlmostEqual(Simulation(NOTHING, FREE, ranks, ranks, 10).efficiency, 1.0)

    def test_one_rank_takes_the_sum(self):
        costs = with_costs(start=1.0, claim=2.0, reading=3.0, append=0.5, part=4.0, index=5.0, index_part=6.0)
        self.assertAlmostEqual(Simulation(costs, FREE, 1, 1, 10).time, 10 + 1 + 2 + 3 + 5 + 4 + 5 + 6)

    def test_the_lock_is_for_one(self):
        last = Simulation(with_costs(claim=2.0), FREE, 20, 20, 10)
        self.assertAlmostEqual(last.time, 20 * 2.0 + 10)
        self.assertAlmostEqual(last.lost["lock"], 20 * 2.0)

    def test_bytes_go_one_after_the_other(self):
        last = Simulation(with_costs(shapes=3), FREE, 20, 20, 10)
        self.assertAlmostEqual(last.time, 20 * 3.0 + 10)
        self.assertAlmostEqual(last.lost["bytes"], 20 * 3.0)

    def test_a_file_system_that_is_full_sets_the_pace(self):
        """20 ranks want 20 bytes in a second of runs, and get one."""
        self.assertGreaterEqual(Simulation(with_costs(record=1), FREE, 20, 20, 10).time, 20 * 10 * 2)

    def test_one_rank_writes_the_index(self):
        self.assertAlmostEqual(Simulation(with_costs(index=1.0, index_part=0.5), FREE, 20, 20, 10).time, 10 + 1 + 20 * 0.5)

    def test_too_few_parts_leave_ranks_idle(self):
        few = Simulation(NOTHING, FREE, 100, 25, 10)
        self.assertAlmostEqual(few.efficiency, 0.25)

    def test_losses_make_the_time(self):
        costs = with_costs(start=1.0, claim=0.1, runs=[0.5, 1.5], append=0.1, record=1, part=1.0, index=1.0)
        some = Simulation(costs, dataclasses.replace(FREE, name=0.01, bandwidth=100.0, durable=0.1), 30, 45, 10)
        even = 45 * 10 * 1.0 / 30
        self.assertAlmostEqual(even + sum(some.lost.values()), some.time)


if __name__ == "__main__":
    unittest.main()
