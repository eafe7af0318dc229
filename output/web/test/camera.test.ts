import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Camera, cross, dot, farthestHit, type Vec} from '../src/camera';

const near = (a: number, b: number): void => assert.ok(Math.abs(a - b) < 1e-9, `${a} is not ${b}`);
const cube: number[] = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1];
const triangles = [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7];

test('the picture has square axes, whichever way is up', () => {
  for (const up of [[0, 0, 1], [0, 1, 0], [1, 0, 0], [0, 0, -1]] as Vec[]) {
    const camera = new Camera(up);
    camera.turn(33, 12);
    const {right, above} = camera.axes;
    for (const v of [right, above, camera.towards]) near(dot(v, v), 1);
    near(dot(right, above), 0);
    near(dot(cross(right, above), camera.towards), 1);
    near(dot(right, up), 0);
    assert.ok(dot(above, up) > 0);
  }
});

test('a fitted machine lies within the view, and pixels lead back to it', () => {
  const camera = new Camera([0, 0, 1]);
  camera.fit(cube, 1.5);
  for (let i = 0; i < cube.length; i += 3) {
    const [x, y] = camera.project(cube.slice(i, i + 3) as Vec, 600, 400);
    assert.ok(x > 0 && x < 600 && y > 0 && y < 400);
  }
  const back = camera.project(camera.unproject(123, 45, 600, 400), 600, 400);
  near(back[0], 123);
  near(back[1], 45);
});

test('a ray meets the face that is turned to the viewer', () => {
  const hit = farthestHit([0.3, 0.3, 0.5], [0, 0, 1], cube, triangles);
  near(hit!.distance, 0.5);
  assert.ok(hit!.triangle === 2 || hit!.triangle === 3);
  assert.equal(farthestHit([2, 2, 2], [0, 0, 1], cube, triangles), null);
});
