import assert from 'node:assert/strict';
import {test} from 'node:test';
import {courseStyles, swatch} from '../src/colours';

test('ten courses have the colours of `figure`, which all differ, then dashes or paler ones', () => {
  const alone = courseStyles(10, false, false), beside = courseStyles(10, true, false);
  assert.deepEqual(alone.slice(0, 3).map((s) => s.colour), ['rgba(0,0,0,1)', 'rgba(0,115,179,1)', 'rgba(214,94,0,1)']);
  assert.equal(new Set(alone.slice(0, 7).map((s) => s.colour)).size, 7);
  assert.deepEqual(alone.map((s) => s.dash), [...new Array<undefined>(7).fill(undefined), [6, 4], [6, 4], [6, 4]]);
  assert.equal(alone[7]!.colour, alone[0]!.colour);
  assert.equal(new Set(beside.map((s) => s.colour)).size, 10);
  assert.ok(beside.every((s) => s.dash === undefined), 'dashes tell data sets apart');
});

test('a colour does not change with the number of courses, up to as many as `figure` tells apart', () => {
  for (const dark of [false, true]) {
    assert.deepEqual(courseStyles(21, false, dark).slice(0, 4), courseStyles(4, false, dark));
    assert.equal(new Set(courseStyles(21, false, dark).map(swatch)).size, 21);
    assert.equal(new Set(courseStyles(30, false, dark).map(swatch)).size, 30);
  }
});
