import assert from 'node:assert/strict';
import {test} from 'node:test';
import {extent, interrupted, residual, rootMeanSquare, rowAt, valueAt, windows} from '../src/course';

const course = {time: [0, 10, 30, 40], values: [1, 3, NaN, 5]};

test('the row at a time is the last at or before it', () => {
  assert.deepEqual([-5, 0, 9.9, 10, 29, 40, 99].map((t) => rowAt(course.time, t)), [0, 0, 0, 1, 1, 3, 3]);
});

test('values lie on straight lines, and are missing outside and beside a gap', () => {
  assert.equal(valueAt(course, 5), 2);
  assert.equal(valueAt(course, 10), 3);
  assert.ok(Number.isNaN(valueAt(course, 20)));
  assert.equal(valueAt(course, 40), 5);
  assert.ok(Number.isNaN(valueAt(course, -1)) && Number.isNaN(valueAt(course, 41)));
});

test('what is set holds until the next row', () => {
  assert.deepEqual([0, 9, 10, 35].map((t) => valueAt({...course, held: true}, t)).map(String), ['1', '1', '3', 'NaN']);
});

test('where rows are farther apart than a gap there is nothing between them', () => {
  const apart = {time: [0, 10, 110, 120], values: [1, 2, 3, 4], longestGap: 50};
  assert.deepEqual([10, 11, 60, 109, 110, 115].map((t) => String(valueAt(apart, t))), ['2', 'NaN', 'NaN', 'NaN', '3', '3.5']);
  assert.ok(Number.isNaN(valueAt({...apart, held: true}, 60)));
  assert.deepEqual(interrupted(apart), {time: [0, 10, 10.1, 110, 120], values: [1, 2, null, 3, 4]});
  assert.deepEqual(interrupted({...apart, longestGap: undefined}), {time: apart.time, values: apart.values});
  const whole = {time: [0, 60, 120], values: [5, 5, 5]};
  assert.deepEqual([...residual(whole, apart)].map(String), ['4', 'NaN', '1']);
});

test('a course goes on where rows are those of another table, and not where samples are missing for longer than a gap', () => {
  const sparse = {time: [0, 10, 20, 30, 40, 50, 100], values: [NaN, 1, NaN, 3, NaN, NaN, 7], longestGap: 50};
  assert.deepEqual(interrupted(sparse).values, [null, 1, undefined, 3, null, null, 7]);
  assert.deepEqual([0, 5, 10, 15, 20, 35, 60, 100].map((t) => String(valueAt(sparse, t))), ['NaN', 'NaN', '1', '1.5', '2', 'NaN', 'NaN', '7']);
  assert.equal(valueAt({...sparse, held: true}, 25), 1);
  assert.deepEqual(interrupted({...sparse, longestGap: undefined}).values, [null, 1, null, 3, null, null, 7]);
});

test('the residual is reference minus other, on the times of the reference', () => {
  const line = {time: [0, 20], values: [0, 20]}, measured = {time: [0, 5, 10], values: [1, 7, 9]};
  assert.deepEqual([...residual(measured, line)], [1, 2, -1]);
});

test('root mean square leaves out what is missing', () => {
  assert.equal(rootMeanSquare([3, NaN, 4]), Math.sqrt(12.5));
  assert.ok(Number.isNaN(rootMeanSquare([NaN])));
});

test('windows share the time evenly, and squares add up to the whole', () => {
  const time = Array.from({length: 100}, (_, i) => i), values = time.map((t) => Math.sin(t));
  const parts = windows({time, values}, 4);
  const whole = Math.sqrt(parts.reduce((s, r) => s + r * r, 0) / 4);
  assert.ok(Math.abs(whole - rootMeanSquare(values)) < 1e-12);
  assert.deepEqual(windows({time: [0, 1, 2, 3], values: [1, NaN, NaN, 2]}, 2), [1, 2]);
});

test('the extent leaves out what is missing', () => {
  assert.deepEqual(extent([[NaN, 2], [-1, 5]]), [-1, 5]);
});
