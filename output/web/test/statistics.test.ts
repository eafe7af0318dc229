import assert from 'node:assert/strict';
import {test} from 'node:test';
import {deviation, mean, rankCorrelation, sorted} from '../src/statistics';

test('ranks agree, disagree, or share their places', () => {
  assert.equal(rankCorrelation([1, 2, 3, 4], [1, 8, 27, 64]), 1);
  assert.equal(rankCorrelation([1, 2, 3, 4], [4, 3, 2, 1]), -1);
  assert.equal(rankCorrelation([1, 2, 3], [5, 5, 5]), 0);
  // Ranks 0.5 0.5 2 3 and 0 1 2 3: 4.5 / sqrt(4.5 · 5).
  assert.ok(Math.abs(rankCorrelation([7, 7, 8, 9], [1, 2, 3, 4]) - 4.5 / Math.sqrt(22.5)) < 1e-12);
});

test('missing values do not count', () => {
  assert.deepEqual(sorted([3, NaN, 1, 2]), [1, 2, 3]);
  assert.equal(mean([1, 2, 6]), 3);
  assert.equal(deviation([1, 2, 3]), 1);
  assert.equal(deviation([1]), 0);
});
