import assert from 'node:assert/strict';
import {test} from 'node:test';
import {misfit, sameCourses, worst} from '../src/sections/run_data';

test('an offset counts in the RMS, and not in what is left when a constant is taken off', () => {
  const {rms, largest, offset, spread} = misfit('T1', 'K', [3, NaN, 5, 4]);
  assert.deepEqual([rms, largest, offset, spread], [Math.sqrt(50 / 3), 5, 4, Math.sqrt(2 / 3)]);
});

test('of a channel without any residual nothing is known', () => {
  const {rms, largest, offset, spread} = misfit('T1', 'K', [NaN, NaN]);
  assert.deepEqual([rms, largest, offset, spread], [NaN, NaN, NaN, NaN]);
});

test('the worst channel is found among those of which something is known', () => {
  const of = (name: string, x: number) => misfit(name, 'K', [x]);
  assert.equal(worst([of('T1', 2), of('T2', NaN), of('T3', 3), of('T4', NaN), of('T5', 1)])?.name, 'T3');
  assert.equal(worst([of('T1', NaN)]), undefined);
});

test('courses are the same on other rows, and others where they differ, end sooner, or have another name', () => {
  const speed = (time: number[], values: number[], name = 'spindle.speed') => [{name, unit: 'rpm', title: '', held: true, time, values}];
  const monday = speed([0, 10, 20, 30], [4000, 4000, 0, 0]);
  assert.ok(sameCourses(monday, speed([0, 20, 30], [4000, 0, 0])));
  for (const other of [speed([0, 20, 30], [6000, 0, 0]), speed([0, 10], [4000, 4000]), speed([0, 20, 30], [4000, 0, 0], 'spindle2.speed'), []])
    assert.ok(!sameCourses(monday, other));
});
