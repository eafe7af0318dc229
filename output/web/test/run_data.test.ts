import assert from 'node:assert/strict';
import {test} from 'node:test';
import {misfit} from '../src/sections/run_data';

test('an offset counts in the RMS, and not in what is left when a constant is taken off', () => {
  const {rms, largest, offset, spread} = misfit('T1', 'K', [3, NaN, 5, 4]);
  assert.deepEqual([rms, largest, offset, spread], [Math.sqrt(50 / 3), 5, 4, Math.sqrt(2 / 3)]);
  assert.ok(Number.isNaN(misfit('T1', 'K', [NaN]).spread));
});
