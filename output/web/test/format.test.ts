import assert from 'node:assert/strict';
import {test} from 'node:test';
import {csv} from '../src/csv';
import {axisText, orDash, roundDown, roundTicks, statesOf, timeText, timeUnitFor, valueText} from '../src/format';
import {cividis, viridis} from '../src/colours';
import {edgesAround} from '../src/edges';

test('times are told as people say them', () => {
  assert.deepEqual([0, 45, 60, 750, 3600, 9300, 36000].map(timeText),
    ['0 s', '45 s', '1 min', '12 min 30 s', '1 h 00 min', '2 h 35 min', '10 h 00 min']);
  assert.deepEqual([60, 600, 30000].map((d) => timeUnitFor(d).unit), ['s', 'min', 'h']);
});

test('every axis has its unit', () => {
  assert.equal(axisText('Temperature', 'degC'), 'Temperature / °C');
  assert.equal(axisText('Tilt', 'urad'), 'Tilt / µrad');
  assert.equal(axisText('Setting', '1'), 'Setting');
});

test('a number that nobody knows is a dash', () => {
  assert.deepEqual([1.5, 0, null, undefined, NaN].map((x) => orDash(x, (known) => known.toFixed(1))), ['1.5', '0.0', '–', '–', '–']);
});

test('values have the digits of their unit and a minus sign', () => {
  assert.equal(valueText(-3.14159, 'K'), '−3.14');
  assert.equal(valueText(12.34, 'um'), '12.3');
  assert.equal(valueText(6000, 'rpm'), '6000');
  assert.equal(valueText(NaN, 'K'), '–');
  assert.equal(valueText(-0.000001, 'K'), '0.00');
});

test('of a value below the digit of its unit two digits are told', () => {
  assert.deepEqual([0.012, -0.025, 0.1].map((x) => valueText(x, 'urad')), ['0.012', '−0.025', '0.1']);
  assert.deepEqual([0.0034, 0.01].map((x) => valueText(x, 'K')), ['0.0034', '0.01']);
  assert.equal(valueText(0.5, 'rpm'), '0.50');
});

test('a title tells what the numbers of a state mean', () => {
  assert.deepEqual([...statesOf('what the offset rests on: 0 waiting, 1 good')], [[0, 'waiting'], [1, 'good']]);
  assert.equal(statesOf('cartridge, 30 mm').size, 0);
});

test('ticks are round, enclose the range and are few', () => {
  for (const [low, high] of [[0, 1], [21.7, 44.2], [-0.003, 0.0041], [5, 5], [-130, 12000]] as const) {
    const ticks = roundTicks(low, high);
    assert.ok(ticks[0]! <= low && ticks[ticks.length - 1]! >= high, String(ticks));
    assert.ok(ticks.length >= 2 && ticks.length <= 10, String(ticks));
  }
  assert.deepEqual(roundTicks(20.3, 54), [20, 25, 30, 35, 40, 45, 50, 55]);
});

test('factors are one, two or five', () => {
  assert.deepEqual([1, 1.9, 2, 4.9, 5, 9.99, 730].map(roundDown), [1, 1, 2, 2, 5, 5, 500]);
});

test('maps of colours grow lighter all the way', () => {
  const lightness = ([r, g, b]: readonly number[]): number => 0.2126 * (r! / 255) ** 2.2 + 0.7152 * (g! / 255) ** 2.2 + 0.0722 * (b! / 255) ** 2.2;
  for (const map of [viridis, cividis]) {
    const all = Array.from({length: 101}, (_, i) => lightness(map(i / 100)));
    for (let i = 1; i < all.length; ++i) assert.ok(all[i]! > all[i - 1]!, `at ${i}`);
  }
});

test('a table has a header, quotes what needs it, and leaves out what is missing', () => {
  assert.equal(csv([{name: 'time_s', values: [0, 60]}, {name: 'T1_degC', values: [20.123456789, NaN]}, {name: 'run', values: ['a,b', 'c"d']}]),
    'time_s,T1_degC,run\n0,20.12346,"a,b"\n60,,"c""d"\n');
});

test('edges lie half-way between places', () => {
  assert.deepEqual(edgesAround([0, 10, 30]), [-5, 5, 20, 40]);
  assert.deepEqual(edgesAround([3]), [2.5, 3.5]);
});
