import assert from 'node:assert/strict';
import {test} from 'node:test';
import {csv} from '../src/csv';
import {courseColumns} from '../src/sections/courses';

test('a constant course has its value at every time of the others', () => {
  const feed = {unit: 'mm/min', title: '', held: true}, time = [0, 10, 20];
  const channels = [{...feed, name: 'x.feed', time: [0, 20], values: [500, 500]}, {...feed, name: 'z.feed', time, values: [0, 200, 0]}];
  const table = csv(courseColumns([{name: 'run', index: 0, channels}]));
  assert.equal(table, 'time_s,x.feed_mm/min,z.feed_mm/min\n0,500,0\n10,500,200\n20,500,0\n');
});

test('courses of other data sets are those at the times of the reference', () => {
  const warm = {name: 'T1', unit: 'degC', title: ''};
  const runs = [{name: 'a', index: 0, channels: [{...warm, time: [0, 10], values: [20, 21]}]},
    {name: 'b', index: 1, channels: [{...warm, time: [0, 5, 20], values: [20, 22, 22]}]}];
  assert.equal(csv(courseColumns(runs)), 'time_s,a.T1_degC,b.T1_degC\n0,20,20\n10,21,22\n');
});
